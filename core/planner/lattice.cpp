// SPDX-License-Identifier: MIT
#include "core/planner/lattice.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/planner/scene_stats.hpp"

namespace octocell {
namespace {

constexpr int kNoBits = 1000;  // for zero, which is a multiple of everything

/// Returns the exponent of the lowest bit that is set.
int lowest_bit(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value) & 0x7fffffffU;
  if (bits == 0) return kNoBits;
  const std::uint32_t exponent = bits >> 23;
  const std::uint32_t significand = (bits & 0x7fffffU) | (exponent == 0 ? 0U : 1U << 23);
  return static_cast<int>(exponent == 0 ? 1 : exponent) - 150 + std::countr_zero(significand);
}

int lowest_bit(std::span<const Sphere> spheres) {
  int lowest = kNoBits;
  for (const Sphere& s : spheres) {
    lowest = std::min({lowest, lowest_bit(s.x), lowest_bit(s.y), lowest_bit(s.z), lowest_bit(s.r)});
  }
  return lowest;
}

bool float32_is_exact(double units_per_length, float r_max) {
  return 2.0 * static_cast<double>(r_max) * units_per_length < 0x1p12 &&
         units_per_length >= 0x1p-52 && units_per_length <= 0x1p74;
}

}  // namespace

double find_lattice(std::span<const Sphere> few, std::span<const Sphere> all, float r_max) {
  const int exponent = lowest_bit(few);
  if (exponent == kNoBits) return 0.0;
  const double units_per_length = std::ldexp(1.0, -exponent);
  if (!float32_is_exact(units_per_length, r_max)) return 0.0;
  return lie_on_lattice(all, units_per_length) ? units_per_length : 0.0;
}

}  // namespace octocell
