// SPDX-License-Identifier: MIT
// Floats and pairs of spheres that shrink, for RapidCheck: a failure is reported with the simplest
// numbers that still fail.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ios>
#include <ostream>

#include "core/overlap.hpp"
#include "core/sphere.hpp"

namespace octocell {

inline std::ostream& operator<<(std::ostream& out, const Sphere& s) {
  return out << std::hexfloat << "{" << s.x << "F, " << s.y << "F, " << s.z << "F, " << s.r << "F}";
}

namespace properties {

using rc::Gen;
namespace gen = rc::gen;

/// Generates a range, beginning with its first case; RapidCheck would begin with a few small
/// numbers.
template <typename T>
Gen<T> whole_range(T low, T end) {
  return gen::resize(rc::kNominalSize, gen::inRange<T>(low, end));
}

inline float from_parts(bool negative, std::uint32_t exponent, std::uint32_t significand) {
  return std::bit_cast<float>((negative ? 1U << 31 : 0U) | exponent << 23 | significand);
}

/// Generates random bits, few bits, none, or all: sums and products that are exact, and some that
/// must be rounded.
inline Gen<std::uint32_t> significand() {
  constexpr std::uint32_t kEnd = 1U << 23;
  const auto few_bits =
      gen::map(whole_range<std::uint32_t>(0, 16), [](std::uint32_t top) { return top << 19; });
  return gen::oneOf(whole_range<std::uint32_t>(0, kEnd), few_bits,
                    gen::element<std::uint32_t>(0, 1, kEnd - 1));
}

/// Generates any finite float with a biased exponent in [low, end): 0 is subnormal, 254 the
/// largest.
inline Gen<float> float_between(std::uint32_t low, std::uint32_t end) {
  return gen::apply(from_parts, gen::arbitrary<bool>(), whole_range(low, end), significand());
}

/// Generates numbers at which the arithmetic changes its behaviour.
inline Gen<float> landmark() {
  return gen::element(0.0F, -0.0F, 0x1p-149F, -0x1p-149F, 0x1.fffffcp-127F, 0x1p-126F, -0x1p-126F,
                      kFloatMax, -kFloatMax, 0x1p127F, kFastRadiusMin, kFastRadiusMax,
                      kSafeRadiusFloor, 0x1p-35F, 0x1p-75F, 0x1p63F, 0x1p64F, 1.0F, -1.0F, 0x1p24F);
}

inline float nudged(float value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafter(value, kFloatMax);
  for (; ulps < 0; ++ulps) value = std::nextafter(value, -kFloatMax);
  return value;
}

inline Gen<float> any_float() {
  const auto around = gen::apply(nudged, landmark(), whole_range(-3, 4));
  return gen::oneOf(float_between(0, 255), around,
                    gen::map(whole_range(-9, 10), [](int k) { return static_cast<float>(k); }),
                    float_between(0, 4));
}

inline Gen<float> any_radius() {
  return gen::map(any_float(), [](float r) { return std::fabs(r); });
}

inline Gen<Sphere> any_sphere() {
  return gen::construct<Sphere>(any_float(), any_float(), any_float(), any_radius());
}

struct Two {
  Sphere a;
  Sphere b;
};
inline std::ostream& operator<<(std::ostream& out, const Two& two) {
  return out << two.a << ", " << two.b;
}

inline Sphere nudged(const Sphere& s, const std::array<int, 4>& ulps) {
  return {nudged(s.x, ulps[0]), nudged(s.y, ulps[1]), nudged(s.z, ulps[2]),
          std::fabs(nudged(s.r, ulps[3]))};
}

/// Puts b where it touches a in direction `to`, up to rounding and a few ulps, at any scale.
inline Two tangent(const Sphere& a, float r, const std::array<int, 3>& to,
                   const std::array<int, 4>& ulps) {
  const double length =
      std::sqrt(double(to[0]) * to[0] + double(to[1]) * to[1] + double(to[2]) * to[2]);
  const double step = length == 0.0 ? 0.0 : (static_cast<double>(a.r) + r) / length;
  const auto along = [&](float from, int by) {
    const double there = from + step * by;
    return static_cast<float>(std::clamp<double>(there, -kFloatMax, kFloatMax));
  };
  return {a, nudged({along(a.x, to[0]), along(a.y, to[1]), along(a.z, to[2]), r}, ulps)};
}

/// Generates numbers of one scale, from subnormal to overflow.
inline Gen<Two> tangent_pair() {
  return gen::mapcat(whole_range<std::uint32_t>(0, 250), [](std::uint32_t exponent) {
    const auto number = float_between(exponent, exponent + 5);
    const auto radius = gen::map(number, [](float r) { return std::fabs(r); });
    return gen::apply(tangent, gen::construct<Sphere>(number, number, number, radius), radius,
                      gen::container<std::array<int, 3>>(whole_range(-9, 10)),
                      gen::container<std::array<int, 4>>(whole_range(-2, 3)));
  });
}

/// Ties over the integers (3, 4, 12, 13 and the like), times a power of two, an ulp off or not.
inline Two tie(const std::array<int, 4>& quadruple, int part, int exponent,
               const std::array<int, 4>& ulps) {
  const auto scaled = [exponent](int k) { return std::ldexp(static_cast<float>(k), exponent); };
  const int own = std::min(part, quadruple[3]);
  const Sphere b = {scaled(quadruple[0]), scaled(quadruple[1]), scaled(quadruple[2]),
                    scaled(quadruple[3] - own)};
  return {{0, 0, 0, scaled(own)}, nudged(b, ulps)};
}

inline Gen<Two> tied_pair() {
  using Quadruple = std::array<int, 4>;
  const auto quadruple =
      gen::element(Quadruple{0, 0, 1, 1}, Quadruple{0, 3, 4, 5}, Quadruple{1, 2, 2, 3},
                   Quadruple{2, 3, 6, 7}, Quadruple{3, 4, 12, 13}, Quadruple{2, 5, 14, 15});
  return gen::apply(tie, quadruple, whole_range(0, 16), whole_range(-149, 123),
                    gen::container<std::array<int, 4>>(whole_range(-1, 2)));
}

inline Gen<Two> any_pair() {
  const auto unrelated = gen::construct<Two>(any_sphere(), any_sphere());
  return gen::oneOf(unrelated, tangent_pair(), tied_pair());
}

}  // namespace properties
}  // namespace octocell
