// SPDX-License-Identifier: MIT
// One pair: how near is it to a tie, and do all levels of the predicate decide it correctly?
#pragma once

#include <cstdint>

#include "core/overlap.hpp"
#include "harness/verify/near_tangent/column_oracle.hpp"
#include "harness/verify/near_tangent/families.hpp"

namespace octocell::near_tangent {

/// Counts over the pairs tried.
struct Tally {
  std::uint64_t tried = 0;
  std::uint64_t near = 0;        // |D - R| <= 64 * 2^-24 R: pairs that float32 may decide wrongly
  std::uint64_t mismatches = 0;  // of all tried: a level was certain, but the integers disagree
  std::uint64_t float32_wrong = 0;  // of the near ones: D <= R in plain float32 is wrong
  std::uint64_t first_wrong = ~std::uint64_t{0};  // number of the first pair that is wrong
};

OCTOCELL_HD bool is_near_tie(const Two& two) {
  const auto& [a, b] = two;
  const exact::Float64Test<double> test(a.x, a.y, a.z, a.r, b.x, b.y, b.z, b.r);
  return fabs(test.excess) <= 0x1p-18 * test.radius_sum2;
}

/// Returns true if a level is uncertain, or certain and right.
OCTOCELL_HD bool is_right(Verdict verdict, bool truth) {
  return verdict == Verdict::uncertain || (verdict == Verdict::overlap) == truth;
}

OCTOCELL_HD bool all_levels_are_right(const Two& two, bool truth) {
  const auto& [a, b] = two;
  const bool fast = in_fast_range(a.r) && in_fast_range(b.r);
  return is_right(filter_verdict<Filter::safe>(a, b), truth) &&
         (!fast || is_right(filter_verdict<Filter::fast>(a, b), truth)) &&
         is_right(exact::float64_test(a, b), truth) && exact::integer_test(a, b) == truth;
}

OCTOCELL_HD void add(Tally& sum, const Tally& other) {
  sum.tried += other.tried;
  sum.near += other.near;
  sum.mismatches += other.mismatches;
  sum.float32_wrong += other.float32_wrong;
  if (other.first_wrong < sum.first_wrong) sum.first_wrong = other.first_wrong;
}

/// Tries pairs begin, begin + stride, ... below end.
OCTOCELL_HD Tally try_pairs(Family family, std::uint64_t begin, std::uint64_t end,
                            std::uint64_t stride) {
  Tally tally;
  for (std::uint64_t number = begin; number < end; number += stride) {
    const Two two = make(family, number);
    const bool truth = overlap(two.a, two.b);
    ++tally.tried;
    if (!all_levels_are_right(two, truth)) {
      ++tally.mismatches;
      if (number < tally.first_wrong) tally.first_wrong = number;
    }
    if (!is_near_tie(two)) continue;
    ++tally.near;
    const float radius_sum = two.a.r + two.b.r;
    if ((filter_distance2(two.a, two.b) <= radius_sum * radius_sum) != truth) ++tally.float32_wrong;
  }
  return tally;
}

}  // namespace octocell::near_tangent
