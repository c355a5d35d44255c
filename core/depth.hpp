// SPDX-License-Identifier: MIT
// How deep do two spheres overlap?  r_p + r_q - |p - q|, rounded to float32.
//
// With s = r_p + r_q and D = |p - q|^2 it is (s^2 - D) / (s + sqrt D). Nothing cancels below the
// line. Above it float64 is enough where the sides differ clearly; near contact the difference is
// taken without rounding, or of integers. The error is at most 0.5 + 2.5e-6 ULP of float32 (proof:
// docs/exactness.md). Compiled without contraction, as the predicate.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/host_device.hpp"
#include "core/pair.hpp"
#include "core/predicate.hpp"
#include "core/sphere.hpp"

namespace octocell {
namespace exact {

/// What s^2 - D must be of s^2 + D for roundings of both not to matter.
inline constexpr double kClearDifference = 0x1p-8;

/// s^2 - D from integers: seventeen roundings of 2^-53, whatever cancels. Limbs are subtracted
/// from the highest on; as long as they cancel, the sum is a whole number that float64 holds.
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

/// The depth of two finite spheres with r >= 0: 0 where they touch exactly, negative where they
/// are apart, infinite where no float32 is that large. In the scene's unit of length.
OCTOCELL_HD float penetration_depth(const Sphere& a, const Sphere& b) {
  const exact::Float64Test<double> test(a.x, a.y, a.z, a.r, b.x, b.y, b.z, b.r);
  double difference = test.radius_sum2 - test.distance2;
  const bool clear =
      std::fabs(difference) > exact::kClearDifference * (test.radius_sum2 + test.distance2);
  if (!clear && test.rounding != 0.0) difference = exact::integer_difference(a, b);
  if (difference == 0.0) return 0.0F;  // they touch, or are one and the same point
  return static_cast<float>(difference / (test.radius_sum + std::sqrt(test.distance2)));
}

/// Of each pair, in their order.
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
