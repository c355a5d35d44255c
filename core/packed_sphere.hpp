// SPDX-License-Identifier: MIT
// A sphere in eight bytes: position and radius in units of 2^k, sixteen bits each.
//
// Positions are relative to a cell that repeats in space, so sixteen bits are enough anywhere. A
// difference is taken modulo the cell; it is the true one if two spheres are less than half a cell
// apart. So no offset has to be stored, whichever cells the two spheres lie in. Half a cell is at
// least twice the largest sum of two radii, so spheres that overlap are always that close.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell {

struct PackedSphere {
  std::uint16_t x;
  std::uint16_t y;
  std::uint16_t z;
  std::uint16_t r;
};
static_assert(sizeof(PackedSphere) == 8);

/// The unit of a scene's packed spheres.
struct Packing {
  float units_per_length = 1.0F;  // 2^-k
  float half_cell = 0.0F;         // in scene units; infinite if no float is large enough
};

OCTOCELL_HD bool are_near(const Sphere& a, const Sphere& b, const Packing& packing) {
  return fabsf(a.x - b.x) < packing.half_cell && fabsf(a.y - b.y) < packing.half_cell &&
         fabsf(a.z - b.z) < packing.half_cell;
}

/// 16-bit integers: a cell is 2^16 units wide.
namespace q16 {

inline constexpr float kUnitsPerCell = 65536.0F;

/// Returns floor(value * 2^-k) modulo 2^16. The product is either exact, or too small for a float
/// (then it counts as zero), or so large that it is a multiple of 2^16.
OCTOCELL_HD std::uint16_t place(float value, const Packing& packing) {
  const float units = value * packing.units_per_length;
  if (!(fabsf(units) < 0x1p40F)) return 0;
  const float whole = floorf(units);
  const float in_cell = whole - kUnitsPerCell * floorf(whole * (1.0F / kUnitsPerCell));
  return static_cast<std::uint16_t>(static_cast<std::int32_t>(in_cell));
}

/// Returns the radius, rounded to the nearest unit.
OCTOCELL_HD std::uint16_t nearest_radius(float r, const Packing& packing) {
  return static_cast<std::uint16_t>(
      static_cast<std::int32_t>(floorf(r * packing.units_per_length + 0.5F)));
}
/// Returns an upper bound of the radius.
OCTOCELL_HD std::uint16_t upper_radius(float r, const Packing& packing) {
  return static_cast<std::uint16_t>(
      static_cast<std::int32_t>(floorf(r * packing.units_per_length)) + 1);
}

/// Returns b - a modulo the cell, in [-2^15, 2^15).
OCTOCELL_HD std::int32_t difference(std::uint16_t a, std::uint16_t b) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(b - a));
}

/// Returns a lower bound of the distance along an axis, in units: both positions were rounded down.
OCTOCELL_HD std::int32_t least_distance(std::uint16_t a, std::uint16_t b) {
  const std::int32_t d = difference(a, b);
  const std::int32_t distance = d < 0 ? -d : d;
  return distance > 0 ? distance - 1 : 0;
}

/// Compares squares. Three squares of at most 2^30 fit into 32 bits without a sign.
OCTOCELL_HD bool within(std::int32_t dx, std::int32_t dy, std::int32_t dz,
                        std::int32_t radius_sum) {
  const auto square = [](std::int32_t v) {
    return static_cast<std::uint32_t>(v) * static_cast<std::uint32_t>(v);
  };
  return square(dx) + square(dy) + square(dz) <= square(radius_sum);
}

OCTOCELL_HD bool may_overlap(const PackedSphere& a, const PackedSphere& b) {
  return within(difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z), a.r + b.r);
}
OCTOCELL_HD bool may_overlap_exactly(const PackedSphere& a, const PackedSphere& b) {
  return within(least_distance(a.x, b.x), least_distance(a.y, b.y), least_distance(a.z, b.z),
                a.r + b.r);
}

}  // namespace q16

/// IEEE 754 binary16: a cell is four units wide, so positions lie in [-2, 2].
namespace f16 {

inline constexpr float kUnitsPerCell = 4.0F;

/// Rounds to nearest, ties to even. Needs |value| < 65520.
OCTOCELL_HD std::uint16_t from_float(float value) {
  std::uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  const std::uint32_t sign = bits >> 16 & 0x8000U;
  bits &= 0x7fffffffU;
  if (bits < 0x38800000U) {  // below 2^-14, binary16 has steps of 2^-24: adding 0.5 rounds to them
    const float shifted = fabsf(value) + 0.5F;
    memcpy(&bits, &shifted, sizeof bits);
    return static_cast<std::uint16_t>(sign | (bits - 0x3f000000U));
  }
  bits += 0xfffU + (bits >> 13 & 1U);
  return static_cast<std::uint16_t>(sign | ((bits >> 13) - (112U << 10)));
}

OCTOCELL_HD float to_float(std::uint16_t half) {
#ifdef __CUDA_ARCH__
  float converted;
  asm("cvt.f32.f16 %0, %1;" : "=f"(converted) : "h"(half));
  return converted;
#else
  const std::uint32_t magnitude = (half & 0x7fffU) << 13;
  float value;
  memcpy(&value, &magnitude, sizeof value);
  value *= 0x1p112F;  // corrects the exponent: the two formats' biases differ by 112
  return (half & 0x8000U) != 0 ? -value : value;
#endif
}

/// Returns value * 2^-k, relative to the nearest cell corner.
OCTOCELL_HD std::uint16_t place(float value, const Packing& packing) {
  const float units = value * packing.units_per_length;
  if (!(fabsf(units) < 0x1p40F)) return 0;
  return from_float(units - kUnitsPerCell * rintf(units * (1.0F / kUnitsPerCell)));
}
OCTOCELL_HD std::uint16_t radius(float r, const Packing& packing) {
  return from_float(r * packing.units_per_length);
}

OCTOCELL_HD float difference(float a, float b) {
  const float d = a - b;
  return d - kUnitsPerCell * rintf(d * (1.0F / kUnitsPerCell));
}

/// Computes in float32: only the positions lose bits to the 16-bit format.
OCTOCELL_HD bool may_overlap(const PackedSphere& a, const PackedSphere& b) {
  const float dx = difference(to_float(a.x), to_float(b.x));
  const float dy = difference(to_float(a.y), to_float(b.y));
  const float dz = difference(to_float(a.z), to_float(b.z));
  const float radius_sum = to_float(a.r) + to_float(b.r);
  return dx * dx + dy * dy + dz * dz <= radius_sum * radius_sum;
}

}  // namespace f16

}  // namespace octocell
