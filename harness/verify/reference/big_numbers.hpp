// SPDX-License-Identifier: MIT
// Converts float32 numbers to exact integers for GMP.
#pragma once

#include <gmpxx.h>

#include <cmath>

#include "core/sphere.hpp"

namespace octocell::reference {

/// Returns the number in units of 2^-149: every finite float32 is an integer multiple of that, at
/// most 2^277 units.
inline mpz_class exactly(float value) {
  return mpz_class(std::ldexp(static_cast<double>(value), 149));
}

/// Both sides of the question, in units of 2^-149 and of 2^-298.
struct Sides {
  mpz_class radius_sum;  // r_p + r_q
  mpz_class distance2;   // |p - q|^2
};

inline Sides sides_of(const Sphere& a, const Sphere& b) {
  const mpz_class dx = exactly(a.x) - exactly(b.x);
  const mpz_class dy = exactly(a.y) - exactly(b.y);
  const mpz_class dz = exactly(a.z) - exactly(b.z);
  return {exactly(a.r) + exactly(b.r), dx * dx + dy * dy + dz * dz};
}

}  // namespace octocell::reference
