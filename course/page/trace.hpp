// SPDX-License-Identifier: MIT
// The stages of home_phantom and half_shell for a few spheres, with everything kept that a page
// wants to show. Cells, rules and the exact test are those of core/; nothing here is fast.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid.hpp"
#include "core/sphere.hpp"

namespace course {

using octocell::Cell;
using octocell::Sphere;

enum class Rule : std::uint8_t { as_written, chapter32, lowest_cell, half_shell };

inline constexpr std::uint32_t kEmpty = 0xffffffff;  // the cell id of a slot that holds no cell

/// A sphere in a cell; an empty slot has the id kEmpty.
struct Entry {
  std::uint32_t cell_id = kEmpty;
  std::uint32_t sphere = 0;
  bool is_phantom = false;
  Cell cell = {0, 0, 0};
};

/// One pass of the radix sort. `places` says where each entry of the array before goes.
struct Pass {
  int shift;
  int bits;
  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> places;
  std::vector<Entry> entries;  // afterwards
};

struct IndexCell {
  std::uint32_t cell_id;
  std::uint32_t begin;
  std::uint32_t homes;
  std::uint32_t phantoms;
};

enum class Verdict : std::uint8_t { passed_over, apart, overlap };

/// Why a pair is tested in a cell, or is passed over there.
enum class Reason : std::uint8_t {
  home_with_home,
  phantom_has_larger_home,
  phantom_has_smaller_home,
  both_phantoms,
  home_of_lower_type_holds_both,
  no_home_of_lower_type_holds_both,
  lowest_common_cell,
  not_lowest_common_cell,
  same_row,
  neighbouring_row,
};

struct Considered {
  std::uint32_t i;
  std::uint32_t j;
  std::uint32_t cell_id;
  Verdict verdict;
  Reason reason;
};

struct Pair {
  std::uint32_t i;
  std::uint32_t j;
};

struct Trace {
  double side = 0;               // of a cell
  double corner[3] = {0, 0, 0};  // of cell (0, 0, 0)
  double column = 0;             // the width of a column; a cell's side but for half_shell
  std::uint32_t counts[3] = {1, 1, 1};
  int key_bits = 0;
  std::vector<Entry> entries;
  std::vector<Pass> passes;
  std::vector<IndexCell> cells;
  std::vector<Considered> considered;
  std::vector<Pair> pairs;  // as found: sorted, duplicates kept
};

/// Runs all stages. `side` is the cell side for rule lowest_cell; 0 takes 2 r_max. Rules with a
/// side of their own ignore it. `spheres` must be finite, with r >= 0.
Trace trace_scene(std::span<const Sphere> spheres, Rule rule, double side);

/// Every pair that overlaps, by comparing all.
std::vector<Pair> exact_pairs(std::span<const Sphere> spheres);

}  // namespace course
