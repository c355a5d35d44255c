// SPDX-License-Identifier: MIT
// The claims of docs/exactness.md in arbitrary precision: only GMP, without float64 on the way.
#pragma once

#include <gmpxx.h>

#include "core/sphere.hpp"

namespace octocell::properties {

/// Every finite float32 and float64 is a rational number.
inline mpq_class exactly(double value) { return mpq_class(value); }

inline mpz_class floor_of(const mpq_class& value) {
  mpz_class floor;
  mpz_fdiv_q(floor.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  return floor;
}
inline mpz_class ceiling_of(const mpq_class& value) { return -floor_of(-value); }

inline mpq_class gap_along(float p, float q) { return abs(exactly(p) - exactly(q)); }

/// |p - q|^2 <= (r_p + r_q)^2.
inline bool overlap(const Sphere& a, const Sphere& b) {
  const mpq_class dx = gap_along(a.x, b.x);
  const mpq_class dy = gap_along(a.y, b.y);
  const mpq_class dz = gap_along(a.z, b.z);
  const mpq_class radius_sum = exactly(a.r) + exactly(b.r);
  return dx * dx + dy * dy + dz * dz <= radius_sum * radius_sum;
}

}  // namespace octocell::properties
