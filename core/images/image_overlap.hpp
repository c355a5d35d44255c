// SPDX-License-Identifier: MIT
// Does sphere p, moved by S boxes, overlap sphere q?  |p - q + S H|^2 <= (r_p + r_q + gap)^2,
// decided over the reals. H are the vectors of the box.
//
// Two levels, each certain when it decides (proofs: docs/exactness.md):
//   1. float64 that keeps what its roundings lost: exact, or certain within a bound, or "uncertain"
//   2. integers: all inputs are multiples of 2^-201
// Compiled without contraction (-ffp-contract=off): level 1 needs each operation as written.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/host_device.hpp"
#include "core/overlap.hpp"
#include "core/sphere.hpp"
#include "include/octocell/box.hpp"

namespace octocell {

/// What is decided. `gap` is 0 or lies between kLeastGap and the largest float32.
struct ImageTest {
  Sphere p;
  Sphere q;
  Shift shift;
  double gap;
};
inline constexpr double kLeastGap = 0x1p-149;

namespace exact {

/// A real number that differs from `value` by at most the sum of what roundings lost.
struct Along {
  double value;
  double lost;
};

OCTOCELL_HD void add_multiple(Along& sum, std::int32_t factor, float length) {
  using std::abs;
  using std::fma;
  if (factor == 0) return;  // the vector of an axis that does not repeat is not read
  const double product = static_cast<double>(factor) * static_cast<double>(length);
  const double product_lost =
      fma(static_cast<double>(factor), static_cast<double>(length), -product);
  const Sum<double> next = two_sum<double>(sum.value, product);
  sum.value = next.value;
  sum.lost += abs(next.error) + abs(product_lost);
}

OCTOCELL_HD Along distance_along(float p, float q, const Shift& shift, float a, float b, float c) {
  using std::abs;
  const Sum<double> difference = two_sum<double>(p, -static_cast<double>(q));
  Along along = {difference.value, abs(difference.error)};
  add_multiple(along, shift.a, a);
  add_multiple(along, shift.b, b);
  add_multiple(along, shift.c, c);
  return along;
}

OCTOCELL_HD Verdict image_float64_test(const ImageTest& t, const Box& box) {
  using std::abs;
  const auto& h = box.vector;
  const Along x = distance_along(t.p.x, t.q.x, t.shift, h[0][0], h[1][0], h[2][0]);
  const Along y = distance_along(t.p.y, t.q.y, t.shift, h[0][1], h[1][1], h[2][1]);
  const Along z = distance_along(t.p.z, t.q.z, t.shift, h[0][2], h[1][2], h[2][2]);
  const Sum<double> radii = two_sum<double>(t.p.r, t.q.r);
  const Sum<double> reach = two_sum<double>(radii.value, t.gap);
  const double xx = x.value * x.value;
  const double yy = y.value * y.value;
  const double zz = z.value * z.value;
  const Sum<double> xy = two_sum<double>(xx, yy);
  const Sum<double> xyz = two_sum<double>(xy.value, zz);
  const double reach2 = reach.value * reach.value;
  const double excess = xyz.value - reach2;
  const double lost = x.lost + y.lost + z.lost;
  const double length = abs(x.value) + abs(y.value) + abs(z.value);
  const double bound = 0x1p-49 * (xyz.value + reach2) + 2.0 * lost * (2.0 * length + lost);
  if (excess > bound) return Verdict::apart;
  if (excess < -bound) return Verdict::overlap;
  const double rounding =
      lost + abs(radii.error) + abs(reach.error) + abs(xy.error) + abs(xyz.error) +
      abs(square_error<double>(x.value, xx)) + abs(square_error<double>(y.value, yy)) +
      abs(square_error<double>(z.value, zz)) + abs(square_error<double>(reach.value, reach2));
  if (rounding != 0.0) return Verdict::uncertain;
  return excess <= 0.0 ? Verdict::overlap : Verdict::apart;
}

/// A number in units of 2^-201, in two's complement, the lowest limb first. Sums stay below 2^363,
/// so they never overflow.
struct Wide {
  static constexpr int kLimbs = 12;
  std::uint32_t limb[kLimbs] = {};
};
struct WideSquare {
  std::uint32_t limb[2 * Wide::kLimbs] = {};
};

/// Adds magnitude * 2^shift, or subtracts it. Needs shift < 32 * (kLimbs - 2).
OCTOCELL_HD void add_bits(Wide& sum, std::uint64_t magnitude, int shift, bool negative) {
  const int within = shift % 32;
  const std::uint64_t low = magnitude << within;
  const std::uint64_t high = within == 0 ? 0 : magnitude >> (64 - within);
  const std::uint64_t digits[3] = {low & 0xffffffffU, low >> 32, high};
  std::int64_t carry = 0;
  for (int k = 0; k + shift / 32 < Wide::kLimbs; ++k) {
    const std::int64_t digit = k < 3 ? static_cast<std::int64_t>(digits[k]) : 0;
    std::uint32_t& limb = sum.limb[k + shift / 32];
    carry += static_cast<std::int64_t>(limb) + (negative ? -digit : digit);
    limb = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
}

/// Adds factor * value. A float32 is a whole number below 2^24, times a power of two.
OCTOCELL_HD void add_multiple(Wide& sum, std::int64_t factor, float value) {
  if (factor == 0) return;
  std::uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  const int exponent = static_cast<int>(bits >> 23 & 0xffU);
  const std::uint64_t significand = (bits & 0x7fffffU) | (exponent == 0 ? 0U : 1U << 23);
  const std::uint64_t times = static_cast<std::uint64_t>(factor < 0 ? -factor : factor);
  const bool negative = (factor < 0) != ((bits >> 31) != 0);
  add_bits(sum, significand * times, (exponent == 0 ? 1 : exponent) + 51, negative);
}

/// Adds a gap, which is a whole number below 2^53, times a power of two.
OCTOCELL_HD void add_gap(Wide& sum, double gap) {
  if (gap == 0.0) return;
  std::uint64_t bits;
  memcpy(&bits, &gap, sizeof bits);
  const std::uint64_t significand = (bits & 0xfffffffffffffU) | std::uint64_t{1} << 52;
  add_bits(sum, significand, static_cast<int>(bits >> 52) - 874, false);
}

OCTOCELL_HD void make_positive(Wide& number) {
  if (number.limb[Wide::kLimbs - 1] >> 31 == 0) return;
  std::uint64_t carry = 1;
  for (std::uint32_t& limb : number.limb) {
    carry += static_cast<std::uint32_t>(~limb);
    limb = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
}

OCTOCELL_HD void add_square(WideSquare& sum, Wide a) {
  make_positive(a);
  for (int i = 0; i < Wide::kLimbs; ++i) {
    if (a.limb[i] == 0) continue;
    std::uint64_t carry = 0;
    for (int j = 0; j < Wide::kLimbs; ++j) {
      carry += std::uint64_t{a.limb[i]} * a.limb[j] + sum.limb[i + j];
      sum.limb[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    for (int k = i + Wide::kLimbs; carry != 0 && k < 2 * Wide::kLimbs; ++k) {
      carry += sum.limb[k];
      sum.limb[k] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
}

OCTOCELL_HD bool image_integer_test(const ImageTest& t, const Box& box) {
  const float from[] = {t.p.x, t.p.y, t.p.z};
  const float to[] = {t.q.x, t.q.y, t.q.z};
  WideSquare distance2;
  for (int axis = 0; axis < 3; ++axis) {
    Wide along;
    add_multiple(along, 1, from[axis]);
    add_multiple(along, -1, to[axis]);
    add_multiple(along, t.shift.a, box.vector[0][axis]);
    add_multiple(along, t.shift.b, box.vector[1][axis]);
    add_multiple(along, t.shift.c, box.vector[2][axis]);
    add_square(distance2, along);
  }
  Wide reach;
  add_multiple(reach, 1, t.p.r);
  add_multiple(reach, 1, t.q.r);
  add_gap(reach, t.gap);
  WideSquare reach2;
  add_square(reach2, reach);
  for (int k = 2 * Wide::kLimbs - 1; k >= 0; --k) {
    if (distance2.limb[k] != reach2.limb[k]) return distance2.limb[k] < reach2.limb[k];
  }
  return true;  // tangent spheres overlap
}

}  // namespace exact

/// Returns the answer for finite numbers and any shift.
OCTOCELL_HD bool images_overlap(const ImageTest& t, const Box& box) {
  const Verdict verdict = exact::image_float64_test(t, box);
  if (verdict != Verdict::uncertain) return verdict == Verdict::overlap;
  return exact::image_integer_test(t, box);
}

}  // namespace octocell
