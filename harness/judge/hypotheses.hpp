// SPDX-License-Identifier: MIT
// What wrong pairs may have in common: one function for each kind of flaw. The facts must outlive
// the hypotheses.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/judge/differences.hpp"
#include "harness/judge/evidence.hpp"
#include "harness/judge/scene_facts.hpp"

namespace octocell::judge {

using Hypotheses = std::vector<Hypothesis>;

/// Flaws of the list as a whole: how ids are written, rows that repeat others or hold nothing.
std::vector<Cause> list_causes(std::span<const ListedPair> list, const Differences& differences,
                               const SceneFacts& facts);
/// The number of rows is round, and pairs are missing: a buffer may have been full.
std::optional<Cause> round_number_of_rows(const Differences& differences, const SceneFacts& facts);

/// How two spheres touch: exactly, to within rounding, by a float32 test.
void add_contact(Hypotheses& all, const SceneFacts& facts);
/// Numbers of the spheres: too large for 16 bits, on two sides of a block's border, first or last.
void add_ids(Hypotheses& all, const SceneFacts& facts);
/// Coordinates: negative ones, both sides of zero.
void add_coordinates(Hypotheses& all, const SceneFacts& facts);
/// Lists that are full: the pairs behind the last one, and spheres with as many as any.
void add_capacity(Hypotheses& all, const Differences& differences, const SceneFacts& facts);
/// Cells of several sides and origins: directions, borders, ids, homes. `example` is a wrong pair.
void add_cells(Hypotheses& all, const SceneFacts& facts, Pair example);
/// The course text's rule, with its mistakes or some of them mended, loses the pair.
void add_text_rules(Hypotheses& all, const SceneFacts& facts);
/// The same, for pairs that it gives twice.
void add_repeating_text_rules(Hypotheses& all, const SceneFacts& facts);
/// Quantities with a bound that fits the wrong pairs: radii, distances from the origin, partners.
void add_bounds(Hypotheses& all, const SceneFacts& facts, std::span<const Pair> wrong);

/// What is reported although it does not overlap.
void add_false_tests(Hypotheses& all, const SceneFacts& facts);
/// The pair is met in several cells, and reported in each.
void add_several_cells(Hypotheses& all, const SceneFacts& facts);

}  // namespace octocell::judge
