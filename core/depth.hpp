// SPDX-License-Identifier: MIT
// How deep do two spheres overlap?  r_p + r_q - |p - q|, rounded to float32.
//
// With s = r_p + r_q and D = |p - q|^2 the depth is (s^2 - D) / (s + sqrt D). The denominator is a
// sum, so nothing cancels there. For the numerator, float64 is enough if s^2 and D clearly differ;
// near contact the difference is taken without rounding, or from integers. The error is at most 0.5
// + 2.5e-6 ULP of float32 (proof: docs/exactness.md). Compiled without contraction, like the
// predicate.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/host_device.hpp"
#include "core/overlap.hpp"
#include "core/pair.hpp"
#include "core/sphere.hpp"

namespace octocell {
namespace exact {

/// If |s^2 - D| is a larger part of s^2 + D than this, their roundings do not matter.
inline constexpr double kClearDifference = 0x1p-8;

/// Returns s^2 - D from integers, with at most seventeen roundings of 2^-53, however much cancels.
/// Limbs are subtracted from the highest down; as long as they cancel, the sum is a whole number
/// that float64 represents exactly.
OCTOCELL_HD double integer_difference(const Sphere& a, const Sphere& b) {
  const auto [distance2, radius_sum2] = integer_sides(a, b);
  double sum = 0.0;
  for (int i = 2 * kLimbs - 1; i >= 0; --i) {
    const std::int64_t limb = std::int64_t{radius_sum2.limb[i]} - std::int64_t{distance2.limb[i]};
    sum = sum * 0x1p32 + static_cast<double>(limb);
  }
  return sum * 0x1p-298;
}

}  // namespace exact

/// Returns how deep two finite spheres with r >= 0 overlap, in the scene's unit of length: 0 if
/// they touch exactly, negative if they are apart, infinite if no float32 is large enough.
OCTOCELL_HD float penetration_depth(const Sphere& a, const Sphere& b) {
  const exact::Float64Test<double> test(a.x, a.y, a.z, a.r, b.x, b.y, b.z, b.r);
  double difference = test.radius_sum2 - test.distance2;
  const bool clear =
      std::fabs(difference) > exact::kClearDifference * (test.radius_sum2 + test.distance2);
  if (!clear && test.rounding != 0.0) difference = exact::integer_difference(a, b);
  if (difference == 0.0) return 0.0F;  // they touch, or are the same point
  return static_cast<float>(difference / (test.radius_sum + std::sqrt(test.distance2)));
}

/// Returns the depth of each pair, in the order of `pairs`.
inline std::vector<float> penetration_depths(std::span<const Sphere> spheres,
                                             std::span<const Pair> pairs) {
  std::vector<float> depths;
  depths.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    depths.push_back(penetration_depth(spheres[pair.i], spheres[pair.j]));
  }
  return depths;
}

}  // namespace octocell
