// SPDX-License-Identifier: MIT
// Spheres side by side, and the first step of each pair test, for one sphere against all of them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include "core/precision.hpp"
#include "core/simd.hpp"

namespace octocell::cpu {

/// Spheres as four arrays, one per field.
template <typename Number>
struct Fields {
  const Number* x;
  const Number* y;
  const Number* z;
  const Number* r;
};
/// The number type that a test reads.
template <PairTest test>
using NumberOf = std::conditional_t<is_packed(test), std::uint16_t, float>;
template <PairTest test>
using FieldsOf = Fields<NumberOf<test>>;
/// Returns the index of the radius of sphere k.
template <PairTest test>
constexpr std::uint64_t place_of_radius(std::uint64_t k) {
  return has_one_radius(test) ? 0 : k;
}

/// One bit per lane; the first lane has the lowest bit.
using LaneBits = std::uint16_t;
inline constexpr std::uint32_t kMostLanes = 16;
template <typename Mask>
LaneBits bits_of(const Mask& mask) {
  return static_cast<LaneBits>(mask.__to_bitset().to_ulong());  // libstdc++'s own function: the
                                                                // standard library has no public
                                                                // one
}
/// Returns the bits of the first `count` lanes; of all kMostLanes if `count` is more.
inline LaneBits first_bits(std::uint32_t count) {
  return static_cast<LaneBits>((1U << std::min(count, kMostLanes)) - 1U);
}
/// Calls visit(lane) for each lane whose bit is set.
template <typename Visit>
void for_each_lane(std::uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

/// Writes first + lane to `to` for each lane whose bit is set. Up to 16 numbers may be written;
/// those come first.
inline void list_places(LaneBits bits, std::uint32_t first, std::uint32_t* to) {
#ifdef __AVX512F__
  const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i places = _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<int>(first)));
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(bits, places));
#else
  for_each_lane(bits, [&](std::uint32_t lane) { *to++ = first + lane; });
#endif
}
/// Writes from[lane] to `to` for each lane whose bit is set. Up to 16 numbers may be written; those
/// come first.
inline void list_values(LaneBits bits, const std::uint32_t* from, std::uint32_t* to) {
#ifdef __AVX512F__
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(bits, _mm512_loadu_si512(from)));
#else
  for_each_lane(bits, [&](std::uint32_t lane) { *to++ = from[lane]; });
#endif
}

/// The centres of spheres side by side.
template <typename V>
struct CentreLanes {
  V x, y, z;
  template <typename Number>
  [[gnu::always_inline]] CentreLanes(const Fields<Number>& of, std::uint64_t at)
      : x(of.x + at, stdx::element_aligned),
        y(of.y + at, stdx::element_aligned),
        z(of.z + at, stdx::element_aligned) {}
};
/// Centres and radii.
template <typename V>
struct SphereLanes : CentreLanes<V> {
  V r;
  template <typename Number>
  [[gnu::always_inline]] SphereLanes(const Fields<Number>& of, std::uint64_t at)
      : CentreLanes<V>(of, at), r(of.r + at, stdx::element_aligned) {}
};

/// Returns D, like filter_distance2().
template <typename V, typename Number>
[[gnu::always_inline]] inline V distance2(const CentreLanes<V>& lanes, const Fields<Number>& ones,
                                          std::uint64_t k) {
  const V dx = lanes.x - static_cast<typename V::value_type>(ones.x[k]);
  const V dy = lanes.y - static_cast<typename V::value_type>(ones.y[k]);
  const V dz = lanes.z - static_cast<typename V::value_type>(ones.z[k]);
  return dx * dx + dy * dy + dz * dz;
}

/// Holds `count` spheres, starting at place `at`; `count` spheres are read even if fewer exist.
/// may_overlap(ones, k) returns the result of the function of that name for each of them and sphere
/// k of `ones`. always_inline everywhere: these functions must become part of their callers' loops,
/// even if a compiler thinks that they are too long.
template <PairTest test, std::uint32_t count>
class Lanes {  // the tests of |p - q|^2 <= (r_p + r_q)^2: the filters, f32, and f64
 public:
  [[gnu::always_inline]] Lanes(const Fields<float>& of, std::uint64_t at) : lanes_(of, at) {}

  [[nodiscard, gnu::always_inline]] LaneBits may_overlap(const Fields<float>& ones,
                                                         std::uint64_t k) const {
    const V radius_sum = lanes_.r + static_cast<Number>(ones.r[k]);
    return bits_of(distance2(lanes_, ones, k) <= radius_sum * radius_sum);
  }

 private:
  using Number = std::conditional_t<test == PairTest::f64, double, float>;
  using V = Vector<Number, count>;
  SphereLanes<V> lanes_;
};

template <std::uint32_t count>
class Lanes<PairTest::filter_equal, count> {
 public:
  [[gnu::always_inline]] Lanes(const Fields<float>& of, std::uint64_t at)
      : lanes_(of, at), reach2_((of.r[0] + of.r[0]) * (of.r[0] + of.r[0])) {}

  [[nodiscard, gnu::always_inline]] LaneBits may_overlap(const Fields<float>& ones,
                                                         std::uint64_t k) const {
    return bits_of(distance2(lanes_, ones, k) <= reach2_);
  }

 private:
  CentreLanes<Vector<float, count>> lanes_;
  Vector<float, count> reach2_;
};

template <std::uint32_t count>
class Lanes<PairTest::f32_sqrt, count> {
 public:
  [[gnu::always_inline]] Lanes(const Fields<float>& of, std::uint64_t at) : lanes_(of, at) {}

  [[nodiscard, gnu::always_inline]] LaneBits may_overlap(const Fields<float>& ones,
                                                         std::uint64_t k) const {
    return bits_of(stdx::sqrt(distance2(lanes_, ones, k)) <= lanes_.r + ones.r[k]);
  }

 private:
  SphereLanes<Vector<float, count>> lanes_;
};

template <std::uint32_t count>
class Lanes<PairTest::boxes, count> {
 public:
  [[gnu::always_inline]] Lanes(const Fields<float>& of, std::uint64_t at) {
    const float* const centres[] = {of.x, of.y, of.z};
    const Floats r(of.r + at, stdx::element_aligned);
    for (int a = 0; a < 3; ++a) {
      const Floats centre(centres[a] + at, stdx::element_aligned);
      low_[a] = centre - r;
      high_[a] = centre + r;
    }
  }

  [[nodiscard, gnu::always_inline]] LaneBits may_overlap(const Fields<float>& ones,
                                                         std::uint64_t k) const {
    const float centre[] = {ones.x[k], ones.y[k], ones.z[k]};
    const float r = ones.r[k];
    auto meet = low_[0] <= centre[0] + r && centre[0] - r <= high_[0];
    for (int a = 1; a < 3; ++a) {
      meet = meet && low_[a] <= centre[a] + r && centre[a] - r <= high_[a];
    }
    return bits_of(meet);
  }

 private:
  using Floats = Vector<float, count>;
  Floats low_[3], high_[3];
};

template <std::uint32_t count>
class Lanes<PairTest::gram, count> {
 public:
  [[gnu::always_inline]] Lanes(const Fields<float>& of, std::uint64_t at)
      : lanes_(of, at), norm2_(lanes_.x * lanes_.x + lanes_.y * lanes_.y + lanes_.z * lanes_.z) {}

  [[nodiscard, gnu::always_inline]] LaneBits may_overlap(const Fields<float>& ones,
                                                         std::uint64_t k) const {
    const Sphere one = {ones.x[k], ones.y[k], ones.z[k], ones.r[k]};
    const Floats product = lanes_.x * one.x + lanes_.y * one.y + lanes_.z * one.z;
    const Floats radius_sum = lanes_.r + one.r;
    return bits_of(norm2_ + pair_tests::norm2(one) - 2.0F * product <= radius_sum * radius_sum);
  }

 private:
  using Floats = Vector<float, count>;
  SphereLanes<Floats> lanes_;
  Floats norm2_;
};

/// 16-bit integers; differences and squares are computed in 32 bits.
template <std::uint32_t count, bool rounded_down>
class Q16Lanes {
 public:
  [[gnu::always_inline]] Q16Lanes(const Fields<std::uint16_t>& of, std::uint64_t at)
      : lanes_(of, at) {}

  [[nodiscard, gnu::always_inline]] LaneBits may_overlap(const Fields<std::uint16_t>& ones,
                                                         std::uint64_t k) const {
    const Integers radius_sum = lanes_.r + static_cast<std::int32_t>(ones.r[k]);
    return bits_of(square_of_distance(lanes_.x, ones.x[k]) +
                       square_of_distance(lanes_.y, ones.y[k]) +
                       square_of_distance(lanes_.z, ones.z[k]) <=
                   square(radius_sum));
  }

 private:
  using Integers = Vector<std::int32_t, count>;
  using Naturals = stdx::rebind_simd_t<std::uint32_t, Integers>;

  static Naturals square(const Integers& v) {
    const auto natural = stdx::static_simd_cast<Naturals>(v);
    return natural * natural;
  }
  /// Computes modulo 2^16, and subtracts one if both positions were rounded down, like
  /// q16::least_distance().
  static Naturals square_of_distance(const Integers& at, std::uint16_t to) {
    const Integers difference = (at - static_cast<std::int32_t>(to)) << 16 >> 16;
    if constexpr (!rounded_down) return square(difference);
    return square(stdx::max(stdx::abs(difference) - 1, Integers(0)));
  }

  SphereLanes<Integers> lanes_;
};
template <std::uint32_t count>
class Lanes<PairTest::q16, count> : public Q16Lanes<count, false> {
  using Q16Lanes<count, false>::Q16Lanes;
};
template <std::uint32_t count>
class Lanes<PairTest::q16_exact, count> : public Q16Lanes<count, true> {
  using Q16Lanes<count, true>::Q16Lanes;
};

/// 16-bit floats, converted to 32 bits when they are read.
template <std::uint32_t count>
class Lanes<PairTest::f16, count> {
 public:
  [[gnu::always_inline]] Lanes(const Fields<std::uint16_t>& of, std::uint64_t at)
      : x_(load(of.x + at)), y_(load(of.y + at)), z_(load(of.z + at)), r_(load(of.r + at)) {}

  [[nodiscard, gnu::always_inline]] LaneBits may_overlap(const Fields<std::uint16_t>& ones,
                                                         std::uint64_t k) const {
    const Floats dx = difference(x_, f16::to_float(ones.x[k]));
    const Floats dy = difference(y_, f16::to_float(ones.y[k]));
    const Floats dz = difference(z_, f16::to_float(ones.z[k]));
    const Floats radius_sum = r_ + f16::to_float(ones.r[k]);
    return bits_of(dx * dx + dy * dy + dz * dz <= radius_sum * radius_sum);
  }

 private:
  using Floats = Vector<float, count>;

  static Floats load(const std::uint16_t* from) {
    return Floats([from](auto lane) { return f16::to_float(from[lane]); });
  }
  /// Computes modulo the cell, like f16::difference(). Positions lie in [-2, 2], so d lies in [-4,
  /// 4].
  static Floats difference(const Floats& at, float to) {
    constexpr float kCell = f16::kUnitsPerCell;
    const Floats d = at - to;
    return d - kCell * stdx::rint(d * (1.0F / kCell));
  }

  Floats x_, y_, z_, r_;
};

}  // namespace octocell::cpu
