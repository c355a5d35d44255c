// SPDX-License-Identifier: MIT
// Do two spheres overlap?  |p - q|^2 <= (r_p + r_q)^2, decided over the reals.
//
// Three levels, each certain when it decides (proofs: docs/exactness.md):
//   1. float32 with a filter: "apart", "overlap", or "uncertain" (few in a million; all ties)
//   2. float64 with an error bound, then with error-free transformations: exact or "uncertain"
//   3. integers: every finite float32 is a multiple of 2^-149
// Compiled without contraction (-ffp-contract=off): level 2 needs each operation as written.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell {

enum class Verdict : std::uint8_t { apart, overlap, uncertain };

/// Level 1 has two forms. `fast` needs every nonzero radius in [2^-60, 2^62]; `safe` has no
/// condition.
enum class Filter : std::uint8_t { fast, safe };

inline constexpr float kFastRadiusMin = 0x1p-60F;
inline constexpr float kFastRadiusMax = 0x1p62F;

// With u = 2^-24, radii grow by 6u. Then H (below) is >= R (1 + 7u), so D > H proves "apart" (D
// carries at most 5 roundings), and D < H (1 - 24u) proves "overlap".
inline constexpr float kRadiusGrowth = 0x1.000006p0F;
inline constexpr float kSureFraction = 0x1.ffffd0p-1F;
inline constexpr float kSafeRadiusFloor = 0x1p-62F;  // keeps H away from underflow
inline constexpr float kSafeSureFloor = 0x1p-70F;    // below it, D may have lost bits
inline constexpr float kFloatMax = 0x1.fffffep127F;

/// Returns the radius as level 1 uses it; called once per sphere.
template <Filter filter>
OCTOCELL_HD float filter_radius(float r) {
  const float grown = r * kRadiusGrowth;
  if constexpr (filter == Filter::fast) return grown;
  return grown < kSafeRadiusFloor ? kSafeRadiusFloor : grown;
}

/// Returns D, the squared distance in float32. The proofs hold for any order of the sums, with or
/// without FMA.
OCTOCELL_HD float filter_distance2(const Sphere& a, const Sphere& b) {
  const float dx = a.x - b.x;
  const float dy = a.y - b.y;
  const float dz = a.z - b.z;
  return dx * dx + dy * dy + dz * dz;
}

/// Returns true for every overlapping pair, and for almost no other. `a.r` and `b.r` are filter
/// radii.
OCTOCELL_HD bool filter_may_overlap(const Sphere& a, const Sphere& b) {
  const float radius_sum = a.r + b.r;
  return !(filter_distance2(a, b) > radius_sum * radius_sum);
}

/// Returns the bound below which D proves "overlap", for `radius_sum2` = H.
template <Filter filter>
OCTOCELL_HD float filter_sure_below(float radius_sum2) {
  const float finite = filter == Filter::fast || radius_sum2 < kFloatMax ? radius_sum2 : kFloatMax;
  return finite * kSureFraction;
}

/// Returns true if a pair that may overlap certainly does. `a.r` and `b.r` are filter radii.
template <Filter filter>
OCTOCELL_HD bool filter_is_sure(const Sphere& a, const Sphere& b) {
  const float radius_sum = a.r + b.r;
  const float radius_sum2 = radius_sum * radius_sum;
  const bool sure = filter_distance2(a, b) < filter_sure_below<filter>(radius_sum2);
  if constexpr (filter == Filter::fast) return sure;
  return radius_sum2 >= kSafeSureFloor && sure;
}

/// Runs all of level 1 for two spheres with their original radii.
template <Filter filter>
OCTOCELL_HD Verdict filter_verdict(Sphere a, Sphere b) {
  a.r = filter_radius<filter>(a.r);
  b.r = filter_radius<filter>(b.r);
  if (!filter_may_overlap(a, b)) return Verdict::apart;
  return filter_is_sure<filter>(a, b) ? Verdict::overlap : Verdict::uncertain;
}

/// Returns true if the fast filter may be used for a sphere of that radius.
OCTOCELL_HD bool in_fast_range(float r) {
  return r == 0.0F || (r >= kFastRadiusMin && r <= kFastRadiusMax);
}

namespace exact {

/// a + b = sum + error, exactly (Knuth, TAOCP vol. 2, 4.2.2, theorem B).
template <typename Real>
struct Sum {
  Real value;
  Real error;
};
template <typename Real>
OCTOCELL_HD Sum<Real> two_sum(Real a, Real b) {
  const Real sum = a + b;
  const Real b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}
template <typename Real>
OCTOCELL_HD Real square_error(Real a, Real square) {
  using std::fma;
  return fma(a, a, -square);
}

/// Returns the error bound of level 2. Both sides together carry at most 8 roundings of 2^-53; a
/// factor of ten leaves room for second-order terms.
template <typename Real>
OCTOCELL_HD Real float64_bound(Real radius_sum2) {
  return 10.0 * 0x1p-53 * radius_sum2;
}

/// Level 2 for two spheres; or for several pairs at once, with a vector of float64 as `Real`.
/// float32 inputs can neither overflow nor underflow here (squares lie in 2^-298..2^260).
template <typename Real>
struct Float64Test {
  Real distance2;    // D
  Real radius_sum;   // the sum of the radii
  Real radius_sum2;  // R
  Real excess;       // D - R
  Real bound;        // beyond it, the sign of the excess is certain
  Real rounding;     // sum of the magnitudes of all rounding errors; if zero, D and R are exact

  OCTOCELL_HD Float64Test(Real ax, Real ay, Real az, Real ar, Real bx, Real by, Real bz, Real br) {
    using std::abs;
    const Sum<Real> dx = two_sum<Real>(ax, -bx);
    const Sum<Real> dy = two_sum<Real>(ay, -by);
    const Sum<Real> dz = two_sum<Real>(az, -bz);
    const Sum<Real> radii = two_sum<Real>(ar, br);
    const Real xx = dx.value * dx.value;
    const Real yy = dy.value * dy.value;
    const Real zz = dz.value * dz.value;
    const Sum<Real> xy = two_sum<Real>(xx, yy);
    const Sum<Real> xyz = two_sum<Real>(xy.value, zz);
    distance2 = xyz.value;
    radius_sum = radii.value;
    radius_sum2 = radius_sum * radius_sum;
    excess = distance2 - radius_sum2;
    bound = float64_bound<Real>(radius_sum2);
    rounding = abs(dx.error) + abs(dy.error) + abs(dz.error) + abs(radii.error) +  //
               abs(xy.error) + abs(xyz.error) +                                    //
               abs(square_error<Real>(dx.value, xx)) + abs(square_error<Real>(dy.value, yy)) +
               abs(square_error<Real>(dz.value, zz)) +
               abs(square_error<Real>(radius_sum, radius_sum2));
  }
};

OCTOCELL_HD Verdict float64_test(const Sphere& a, const Sphere& b) {
  const Float64Test<double> test(a.x, a.y, a.z, a.r, b.x, b.y, b.z, b.r);
  if (test.excess > test.bound) return Verdict::apart;
  if (test.excess < -test.bound) return Verdict::overlap;
  if (test.rounding != 0.0) return Verdict::uncertain;
  return test.excess <= 0.0 ? Verdict::overlap : Verdict::apart;
}

/// Level 3: little-endian integers of `kLimbs` 32-bit limbs, in units of 2^-149.
inline constexpr int kLimbs = 9;  // 288 bits; |p - q| and r_p + r_q need 278

struct Fixed {
  std::uint32_t limb[kLimbs];
};
struct Square {
  std::uint32_t limb[2 * kLimbs];
};

/// Returns |value| as an integer: the significand, shifted by the exponent.
OCTOCELL_HD Fixed fixed_magnitude(float value) {
  std::uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  const std::uint32_t exponent = (bits >> 23) & 0xffU;
  const std::uint64_t significand = (bits & 0x7fffffU) | (exponent == 0 ? 0U : 1U << 23);
  const std::uint32_t shift = exponent == 0 ? 0 : exponent - 1;
  Fixed fixed = {};
  const std::uint64_t spread = significand << (shift % 32);
  fixed.limb[shift / 32] = static_cast<std::uint32_t>(spread);
  fixed.limb[shift / 32 + 1] = static_cast<std::uint32_t>(spread >> 32);
  return fixed;
}

OCTOCELL_HD Fixed add(const Fixed& a, const Fixed& b) {
  Fixed sum;
  std::uint64_t carry = 0;
  for (int i = 0; i < kLimbs; ++i) {
    carry += std::uint64_t{a.limb[i]} + b.limb[i];
    sum.limb[i] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  return sum;
}

OCTOCELL_HD bool less(const Fixed& a, const Fixed& b) {
  for (int i = kLimbs - 1; i > 0; --i) {
    if (a.limb[i] != b.limb[i]) return a.limb[i] < b.limb[i];
  }
  return a.limb[0] < b.limb[0];
}

OCTOCELL_HD Fixed absolute_difference(const Fixed& a, const Fixed& b) {
  const Fixed& high = less(a, b) ? b : a;
  const Fixed& low = less(a, b) ? a : b;
  Fixed difference;
  std::uint64_t borrow = 0;
  for (int i = 0; i < kLimbs; ++i) {
    const std::uint64_t d = std::uint64_t{high.limb[i]} - low.limb[i] - borrow;
    difference.limb[i] = static_cast<std::uint32_t>(d);
    borrow = (d >> 32) & 1U;
  }
  return difference;
}

/// Returns |p - q| for two coordinates of any sign.
OCTOCELL_HD Fixed distance_along_axis(float p, float q) {
  const Fixed a = fixed_magnitude(p);
  const Fixed b = fixed_magnitude(q);
  return (p < 0.0F) == (q < 0.0F) ? absolute_difference(a, b) : add(a, b);
}

/// Adds a * a to `sum`.
OCTOCELL_HD void add_square(Square& sum, const Fixed& a) {
  for (int i = 0; i < kLimbs; ++i) {
    if (a.limb[i] == 0) continue;
    std::uint64_t carry = 0;
    for (int j = 0; j < kLimbs; ++j) {
      carry += std::uint64_t{a.limb[i]} * a.limb[j] + sum.limb[i + j];
      sum.limb[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    for (int k = i + kLimbs; carry != 0 && k < 2 * kLimbs; ++k) {
      carry += sum.limb[k];
      sum.limb[k] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
}

/// Both sides of the predicate: D and R.
struct Sides {
  Square distance2;
  Square radius_sum2;
};
OCTOCELL_HD Sides integer_sides(const Sphere& a, const Sphere& b) {
  Sides sides = {};
  add_square(sides.distance2, distance_along_axis(a.x, b.x));
  add_square(sides.distance2, distance_along_axis(a.y, b.y));
  add_square(sides.distance2, distance_along_axis(a.z, b.z));
  add_square(sides.radius_sum2, add(fixed_magnitude(a.r), fixed_magnitude(b.r)));
  return sides;
}

OCTOCELL_HD bool integer_test(const Sphere& a, const Sphere& b) {
  const auto [distance2, radius_sum2] = integer_sides(a, b);
  for (int i = 2 * kLimbs - 1; i >= 0; --i) {
    if (distance2.limb[i] != radius_sum2.limb[i]) return distance2.limb[i] < radius_sum2.limb[i];
  }
  return true;  // tangent spheres overlap
}

}  // namespace exact

/// Levels 2 and 3: returns the answer for any two finite spheres with r >= 0.
OCTOCELL_HD bool overlap_exact(const Sphere& a, const Sphere& b) {
  const Verdict verdict = exact::float64_test(a, b);
  if (verdict != Verdict::uncertain) return verdict == Verdict::overlap;
  return exact::integer_test(a, b);
}

}  // namespace octocell
