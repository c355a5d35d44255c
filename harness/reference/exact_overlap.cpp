// SPDX-License-Identifier: MIT
#include <gmpxx.h>

#include <cmath>

#include "harness/reference/reference.hpp"

namespace octocell::reference {
namespace {

/// Relative distance between the two sides beyond which a few roundings of 2^-53 cannot matter.
constexpr double kWideMargin = 1e-12;

/// Below this, float64 squares may have lost digits to underflow (float32 inputs never do).
constexpr double kUnderflowFloor = 1e-280;

/// Every finite float32 is an integer multiple of 2^-149, and at most 2^277 of them: exact here.
mpz_class exactly(float value) { return mpz_class(std::ldexp(static_cast<double>(value), 149)); }
/// Every finite float64 is a rational number.
mpq_class exactly(double value) { return mpq_class(value); }

template <typename SphereType>
bool overlap_by_big_numbers(const SphereType& a, const SphereType& b) {
  using Number = decltype(exactly(a.x));
  const Number dx = exactly(a.x) - exactly(b.x);
  const Number dy = exactly(a.y) - exactly(b.y);
  const Number dz = exactly(a.z) - exactly(b.z);
  const Number reach = exactly(a.r) + exactly(b.r);
  const Number distance2 = dx * dx + dy * dy + dz * dz;
  return distance2 <= reach * reach;
}

template <typename SphereType>
bool decide(const SphereType& a, const SphereType& b) {
  const double dx = static_cast<double>(a.x) - static_cast<double>(b.x);
  const double dy = static_cast<double>(a.y) - static_cast<double>(b.y);
  const double dz = static_cast<double>(a.z) - static_cast<double>(b.z);
  const double reach = static_cast<double>(a.r) + static_cast<double>(b.r);
  const double distance2 = dx * dx + dy * dy + dz * dz;
  const double reach2 = reach * reach;
  const bool float64_keeps_its_digits = reach2 > kUnderflowFloor && std::isfinite(reach2);
  if (float64_keeps_its_digits && distance2 > reach2 * (1.0 + kWideMargin)) return false;
  if (float64_keeps_its_digits && distance2 < reach2 * (1.0 - kWideMargin)) return true;
  return overlap_by_big_numbers(a, b);
}

}  // namespace

bool overlap(const Sphere& a, const Sphere& b) { return decide(a, b); }
bool overlap(const DoubleSphere& a, const DoubleSphere& b) { return decide(a, b); }

}  // namespace octocell::reference
