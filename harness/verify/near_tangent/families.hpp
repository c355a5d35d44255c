// SPDX-License-Identifier: MIT
// Pairs of spheres that nearly touch, or just touch. Each is made from a number, so it is the same
// on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell::near_tangent {

struct Two {
  Sphere a;
  Sphere b;
};

enum class Family : std::uint8_t { tangent, offset, exponents, lattice, wide, decimals };
inline constexpr std::array<std::string_view, 6> kFamilyNames = {"tangent", "offset", "exponents",
                                                                 "lattice", "wide",   "decimals"};
inline constexpr std::array<std::string_view, 6> kFamilyWords = {
    "tangent to within some roundings, in any direction",
    "the same, sixteen to thirty-two units from the origin",
    "the same at any scale, subnormal to overflowing",
    "Pythagorean quadruples: exact ties, and one rounding beside",
    "a sphere and one up to 2^40 times smaller",
    "neighbours of a lattice whose spacing is a decimal fraction"};

/// Random bits that depend only on the seed and on how many were drawn before (Steele, Lea and
/// Flood, OOPSLA 2014, SplitMix64).
class Bits {
 public:
  OCTOCELL_HD explicit Bits(std::uint64_t seed) : state_(seed) {}
  OCTOCELL_HD std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  OCTOCELL_HD int below(int end) {
    return static_cast<int>((next() >> 32) * static_cast<std::uint64_t>(end) >> 32);
  }
  /// Returns a number in [low, high).
  OCTOCELL_HD double real(double low, double high) {
    return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
  }

 private:
  std::uint64_t state_;
};

struct Direction {
  double x;
  double y;
  double z;
};
OCTOCELL_HD Direction direction(Bits& bits) {
  Direction d = {bits.real(-1, 1), bits.real(-1, 1), bits.real(-1, 1)};
  const double length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z) + 0x1p-60;
  return {d.x / length, d.y / length, d.z / length};
}

OCTOCELL_HD Sphere sphere(double x, double y, double z, double r) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
          static_cast<float>(r)};
}

/// Puts b where it touches a, up to a few steps of 2^-24.
OCTOCELL_HD Two touching(Bits& bits, double x, double y, double z, double ra, double rb) {
  const Sphere a = sphere(x, y, z, ra);
  const auto r = static_cast<double>(static_cast<float>(rb));
  const Direction d = direction(bits);
  const double distance = (a.r + r) * (1.0 + (bits.below(33) - 16) * 0x1p-24);
  return {a, sphere(a.x + d.x * distance, a.y + d.y * distance, a.z + d.z * distance, r)};
}

OCTOCELL_HD Two tangent(Bits& bits, double from) {
  const double x = from + bits.real(-1, 1);
  const double y = bits.real(-1, 1);
  const double z = bits.real(-1, 1);
  return touching(bits, x, y, z, bits.real(0.25, 1), bits.real(0.25, 1));
}

OCTOCELL_HD double power_of_two(int exponent) { return ldexp(1.0, exponent); }

OCTOCELL_HD Two at_any_scale(Bits& bits) {
  const Two two = tangent(bits, 0.0);
  const double scale = power_of_two(bits.below(264) - 140);
  const auto scaled = [scale](const Sphere& s) {
    return sphere(s.x * scale, s.y * scale, s.z * scale, s.r * scale);
  };
  return {scaled(two.a), scaled(two.b)};
}

/// (m^2 + n^2 - p^2 - q^2)^2 + (2 (mq + np))^2 + (2 (nq - mp))^2 = (m^2 + n^2 + p^2 + q^2)^2
OCTOCELL_HD Two on_lattice(Bits& bits) {
  const int m = 1 + bits.below(400);
  const int n = bits.below(400);
  const int p = bits.below(400);
  const int q = bits.below(400);
  const int sum = m * m + n * n + p * p + q * q;
  const int first = bits.below(sum + 1);
  const double unit = power_of_two(bits.below(61) - 30);
  const int x = bits.below(2000) - 1000;
  const Sphere a = sphere(x * unit, 0, 0, first * unit);
  Sphere b = sphere((x + m * m + n * n - p * p - q * q) * unit, 2.0 * (m * q + n * p) * unit,
                    2.0 * (n * q - m * p) * unit, (sum - first) * unit);
  const int nudge = bits.below(4);
  if (nudge == 1) b.y = nextafterf(b.y, INFINITY);
  if (nudge == 2) b.y = nextafterf(b.y, -INFINITY);
  return {a, b};
}

OCTOCELL_HD Two wide(Bits& bits) {
  const double ra = bits.real(0.5, 1);
  const double rb = ra * power_of_two(-bits.below(41));
  const Direction d = direction(bits);  // a's surface passes near the origin, where floats are fine
  const Sphere a = sphere(-ra * d.x, -ra * d.y, -ra * d.z, ra);
  const double length = sqrt(static_cast<double>(a.x) * a.x + static_cast<double>(a.y) * a.y +
                             static_cast<double>(a.z) * a.z);
  const auto r = static_cast<double>(static_cast<float>(rb));
  const double along = (a.r + r) * (1.0 + (bits.below(33) - 16) * 0x1p-26) / length - 1.0;
  return {a, sphere(-a.x * along, -a.y * along, -a.z * along, r)};
}

OCTOCELL_HD Two decimals(Bits& bits) {
  const auto spacing = static_cast<float>((1 + bits.below(300)) / 100.0);
  const float at[] = {static_cast<float>(bits.below(1000)), static_cast<float>(bits.below(1000)),
                      static_cast<float>(bits.below(1000))};
  const float step[] = {static_cast<float>(bits.below(3) - 1),
                        static_cast<float>(bits.below(3) - 1), 1.0F};
  const float length = sqrtf(step[0] * step[0] + step[1] * step[1] + 1.0F);
  const float r = spacing * length * 0.5F;
  return {
      {spacing * at[0], spacing * at[1], spacing * at[2], r},
      {spacing * (at[0] + step[0]), spacing * (at[1] + step[1]), spacing * (at[2] + step[2]), r}};
}

/// Makes pair `number` of a family. All numbers are finite, and r >= 0.
OCTOCELL_HD Two make(Family family, std::uint64_t number) {
  Bits bits(number * 6 + static_cast<std::uint64_t>(family) + (std::uint64_t{1} << 60));
  Bits mixed(bits.next());
  switch (family) {
    case Family::tangent:
      return tangent(mixed, 0.0);
    case Family::offset:
      return tangent(mixed, 24.0);
    case Family::exponents:
      return at_any_scale(mixed);
    case Family::lattice:
      return on_lattice(mixed);
    case Family::wide:
      return wide(mixed);
    case Family::decimals:
      break;
  }
  return decimals(mixed);
}

}  // namespace octocell::near_tangent
