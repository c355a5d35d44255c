// SPDX-License-Identifier: MIT
// When may one say that wrong pairs have a flaw in common? Only if it holds for all of them, and if
// pairs that are right show that this is no accident: few of them have it, too few for a random
// choice of wrong pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pair.hpp"
#include "harness/trace/text_rule.hpp"

namespace octocell::judge {

/// Pairs that are wrong in one way, and pairs with which they are compared.
struct Evidence {
  std::string_view kind;        // "missed"
  std::string_view right_kind;  // "pairs that were found"
  std::vector<Pair> wrong;
  std::vector<Pair> right;  // all, or evenly spaced ones
};

/// What wrong pairs may have in common.
struct Hypothesis {
  std::string name;                 // short, and always the same
  std::string text;                 // continues "all 38 missed pairs"
  std::function<bool(Pair)> holds;  // for a pair
  /// The flaw spoils some of the pairs for which it holds; most flaws spoil all of them, and then
  /// right pairs for which it holds speak against it.
  bool spoils_some = false;
  double tries = 1.0;  // how many it stands for, if its numbers were chosen to fit
  std::function<trace::Flaw(Pair)> part = {};  // which of several flaws it is for a pair
};

struct CausePart {
  trace::Flaw flaw;
  std::uint64_t count;
};

/// The flaw that wrong pairs have in common.
struct Cause {
  std::string kind;  // missed, false, duplicates, out_of_range, list
  std::string name;
  std::string text;              // a sentence
  std::uint64_t wrong = 0;       // for how many wrong pairs it holds: all
  std::uint64_t right = 0;       // with how many right pairs they were compared
  std::uint64_t right_with = 0;  // for how many of these it holds, too
  std::vector<CausePart> parts = {};
};

/// Returns at most `most` of the pairs, evenly spaced.
std::vector<Pair> spread(std::span<const Pair> pairs, std::size_t most);

/// Returns the hypothesis that holds for all wrong pairs and for the fewest right ones, if it may
/// be claimed. The first of equals counts.
std::optional<Cause> common_cause(const Evidence& evidence, std::span<const Hypothesis> hypotheses);

/// Returns true if wrong and right pairs differ too well for a random choice: see log_chance().
bool may_be_claimed(std::size_t wrong, std::size_t right_with, std::size_t right,
                    double tries = 1.0);

/// Returns true if there are so few pairs that no hypothesis can be told from an accident.
bool is_too_little(const Evidence& evidence);

}  // namespace octocell::judge
