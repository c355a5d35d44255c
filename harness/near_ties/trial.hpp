// SPDX-License-Identifier: MIT
// One pair: how near a tie is it, and are all levels of the predicate right about it?
#pragma once

#include "harness/interface/predicate.hpp"
#include "harness/near_ties/column_oracle.hpp"
#include "harness/near_ties/families.hpp"

namespace octocell::near_ties {

/// Of the pairs tried.
struct Tally {
  std::uint64_t tried = 0;
  std::uint64_t near = 0;           // |D - R| <= 64 * 2^-24 R: what float32 may be wrong about
  std::uint64_t mismatches = 0;     // of all tried: a level is certain of what the integers deny
  std::uint64_t float32_wrong = 0;  // of the near ones: plain D <= R in float32
  std::uint64_t first_wrong = ~std::uint64_t{0};  // its number
};

OCTOCELL_HD bool is_near_tie(const Two& two) {
  const double dx = static_cast<double>(two.a.x) - two.b.x;
  const double dy = static_cast<double>(two.a.y) - two.b.y;
  const double dz = static_cast<double>(two.a.z) - two.b.z;
  const double reach = static_cast<double>(two.a.r) + two.b.r;
  const double r = reach * reach;
  return fabs(dx * dx + dy * dy + dz * dz - r) <= 0x1p-18 * r;
}

/// What the band says, if it is certain, is what is true.
template <Band band>
OCTOCELL_HD bool band_is_right(const Two& two, bool truth) {
  Two grown = two;
  grown.a.r = band_radius<band>(two.a.r);
  grown.b.r = band_radius<band>(two.b.r);
  if (!band_may_overlap(grown.a, grown.b)) return !truth;
  return truth || !band_is_sure<band>(grown.a, grown.b);
}

OCTOCELL_HD bool in_fast_range(float r) {
  return r == 0.0F || (r >= kFastRadiusMin && r <= kFastRadiusMax);
}

OCTOCELL_HD bool all_levels_are_right(const Two& two, bool truth) {
  bool right = band_is_right<Band::safe>(two, truth);
  if (in_fast_range(two.a.r) && in_fast_range(two.b.r)) {
    right = right && band_is_right<Band::fast>(two, truth);
  }
  const Verdict level2 = exact::float64_test(two.a, two.b);
  if (level2 != Verdict::doubt) right = right && (level2 == Verdict::overlap) == truth;
  return right && exact::integer_test(two.a, two.b) == truth;
}

OCTOCELL_HD void add(Tally& sum, const Tally& other) {
  sum.tried += other.tried;
  sum.near += other.near;
  sum.mismatches += other.mismatches;
  sum.float32_wrong += other.float32_wrong;
  if (other.first_wrong < sum.first_wrong) sum.first_wrong = other.first_wrong;
}

/// Pairs begin, begin + stride, ... below end.
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
    const float reach = two.a.r + two.b.r;
    if ((band_distance2(two.a, two.b) <= reach * reach) != truth) ++tally.float32_wrong;
  }
  return tally;
}

}  // namespace octocell::near_ties
