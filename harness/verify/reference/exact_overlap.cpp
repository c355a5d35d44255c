// SPDX-License-Identifier: MIT
#include <cmath>

#include "harness/verify/reference/big_numbers.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {
namespace {

/// If the two sides differ by more than this part, a few roundings of 2^-53 do not matter.
constexpr double kWideMargin = 1e-12;

/// Below this, float64 squares may have lost digits to underflow (with float32 inputs, this never
/// happens).
constexpr double kUnderflowFloor = 1e-280;

bool overlap_by_big_numbers(const Sphere& a, const Sphere& b) {
  const Sides sides = sides_of(a, b);
  return sides.distance2 <= sides.radius_sum * sides.radius_sum;
}

/// Uses rational numbers, which represent every finite float64.
bool overlap_by_big_numbers(const DoubleSphere& a, const DoubleSphere& b) {
  const mpq_class dx = mpq_class(a.x) - mpq_class(b.x);
  const mpq_class dy = mpq_class(a.y) - mpq_class(b.y);
  const mpq_class dz = mpq_class(a.z) - mpq_class(b.z);
  const mpq_class radius_sum = mpq_class(a.r) + mpq_class(b.r);
  return dx * dx + dy * dy + dz * dz <= radius_sum * radius_sum;
}

template <typename SphereType>
bool decide(const SphereType& a, const SphereType& b) {
  const double dx = static_cast<double>(a.x) - static_cast<double>(b.x);
  const double dy = static_cast<double>(a.y) - static_cast<double>(b.y);
  const double dz = static_cast<double>(a.z) - static_cast<double>(b.z);
  const double radius_sum = static_cast<double>(a.r) + static_cast<double>(b.r);
  const double distance2 = dx * dx + dy * dy + dz * dz;
  const double radius_sum2 = radius_sum * radius_sum;
  const bool float64_keeps_its_digits = radius_sum2 > kUnderflowFloor && std::isfinite(radius_sum2);
  if (float64_keeps_its_digits && distance2 > radius_sum2 * (1.0 + kWideMargin)) return false;
  if (float64_keeps_its_digits && distance2 < radius_sum2 * (1.0 - kWideMargin)) return true;
  return overlap_by_big_numbers(a, b);
}

}  // namespace

bool overlap(const Sphere& a, const Sphere& b) { return decide(a, b); }
bool overlap(const DoubleSphere& a, const DoubleSphere& b) { return decide(a, b); }

}  // namespace octocell::reference
