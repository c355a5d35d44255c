// SPDX-License-Identifier: MIT
// Decides |p - q|^2 <= (r_p + r_q)^2 in a third way, unlike the predicate and the reference, so
// that the same mistake would have to be made twice. It multiplies the squares out into products of
// two inputs and adds these, digit by digit, in columns.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell::near_tangent {

/// A float32 as significand * 2^(exponent - 149), exponent in 0..253.
struct Parts {
  std::int64_t significand;  // including the sign
  int exponent;
};
OCTOCELL_HD Parts parts_of(float value) {
  std::uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  const int field = static_cast<int>(bits >> 23 & 0xffU);
  const std::int64_t magnitude = (bits & 0x7fffffU) | (field == 0 ? 0U : 1U << 23);
  return {(bits >> 31) != 0 ? -magnitude : magnitude, field == 0 ? 0 : field - 1};
}

/// A sum of signed products, in units of 2^-298: columns of 32 bits, each with room for many
/// carries.
class ColumnSum {
 public:
  /// Adds factor * a * b; |factor| <= 2.
  OCTOCELL_HD void add(int factor, const Parts& a, const Parts& b) {
    const std::int64_t product = factor * a.significand * b.significand;  // below 2^50
    const bool negative = product < 0;
    const auto magnitude = static_cast<std::uint64_t>(negative ? -product : product);
    const int shift = a.exponent + b.exponent;
    const int column = shift / 32;
    const int within = shift % 32;
    const std::uint64_t low = (magnitude & 0xffffffffU) << within;
    const std::uint64_t high = (magnitude >> 32) << within;
    put(column, low & 0xffffffffU, negative);
    put(column + 1, (low >> 32) + (high & 0xffffffffU), negative);
    put(column + 2, high >> 32, negative);
  }

  /// Returns the sign: -1, 0 or 1.
  [[nodiscard]] OCTOCELL_HD int sign() const {
    std::int64_t carry = 0;
    bool any = false;
    for (int k = 0; k < kColumns; ++k) {
      const std::int64_t here = columns_[k] + carry;
      any = any || (here & 0xffffffff) != 0;
      carry = here >> 32;  // rounds towards minus infinity: the remainder is in 0..2^32 - 1
    }
    if (carry < 0) return -1;
    return any || carry > 0 ? 1 : 0;
  }

 private:
  static constexpr int kColumns = 18;  // the highest exponents add up to 506, and a product has 50
                                       // bits

  OCTOCELL_HD void put(int column, std::uint64_t digit, bool negative) {
    columns_[column] +=
        negative ? -static_cast<std::int64_t>(digit) : static_cast<std::int64_t>(digit);
  }

  std::int64_t columns_[kColumns] = {};
};

OCTOCELL_HD bool overlap(const Sphere& a, const Sphere& b) {
  ColumnSum excess;  // D - R
  const float from[] = {a.x, a.y, a.z};
  const float to[] = {b.x, b.y, b.z};
  for (int axis = 0; axis < 3; ++axis) {
    const Parts p = parts_of(from[axis]);
    const Parts q = parts_of(to[axis]);
    excess.add(1, p, p);
    excess.add(1, q, q);
    excess.add(-2, p, q);
  }
  const Parts r = parts_of(a.r);
  const Parts s = parts_of(b.r);
  excess.add(-1, r, r);
  excess.add(-1, s, s);
  excess.add(-2, r, s);
  return excess.sign() <= 0;
}

}  // namespace octocell::near_tangent
