// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {

void require_available() {}
namespace {

/// Counts pairs that are on one side only, and records how far the worst is from contact.
class Tally {
 public:
  Tally(Comparison& difference, std::span<const Sphere> spheres)
      : difference_(difference), spheres_(spheres) {}

  void miss(Pair pair) {
    if (difference_.missed++ == 0) difference_.first_missed = pair;
    if (!spheres_.empty()) keep_worst(difference_.worst_missed_depth, depth_of(pair));
  }
  void falsely_report(Pair pair) {
    if (difference_.false_pairs++ == 0) difference_.first_false = pair;
    if (!spheres_.empty()) keep_worst(difference_.worst_false_gap, -depth_of(pair));
  }
  void repeat(Pair pair) {
    if (difference_.duplicates++ == 0) difference_.first_duplicate = pair;
  }

 private:
  [[nodiscard]] double depth_of(Pair pair) const {
    return relative_depth(spheres_[pair.i], spheres_[pair.j]);
  }
  static void keep_worst(std::optional<double>& worst, double value) {
    worst = worst ? std::max(*worst, value) : value;
  }

  Comparison& difference_;
  std::span<const Sphere> spheres_;
};

}  // namespace

Comparison compare(std::span<const Pair> answer, std::span<const Pair> truth,
                   std::span<const Sphere> spheres) {
  Comparison difference;
  Tally tally(difference, spheres);
  auto expected = truth.begin();
  for (std::size_t k = 0; k < answer.size(); ++k) {
    if (k > 0 && answer[k] == answer[k - 1]) {
      tally.repeat(answer[k]);
      continue;
    }
    while (expected != truth.end() && *expected < answer[k]) tally.miss(*expected++);
    if (expected != truth.end() && *expected == answer[k]) {
      ++expected;
    } else {
      tally.falsely_report(answer[k]);
    }
  }
  while (expected != truth.end()) tally.miss(*expected++);
  return difference;
}

RoundingEffect rounding_effect(std::span<const DoubleSphere> unrounded, AllFlags flags,
                               std::span<const Pair> pairs_of_rounded) {
  const Comparison change = compare(pairs_of_rounded, box_tree(unrounded, flags));
  return {.lost = change.missed, .gained = change.false_pairs};
}

}  // namespace octocell::reference
