// SPDX-License-Identifier: MIT
// Rule as_written: the text that started this project, followed word for word (the text of a
// course). It is a negative control: it loses pairs (course/lost_pairs.md shows which and
// why), the same ones on every backend.
//
// Where the text leaves a choice, this file fixes one: cells of 1.5 r_max; coordinates truncated to
// unsigned, negative ones saturating at 0; ids of 10-bit fields joined with OR; neighbours in (dz,
// dy, dx) order, of which only the first seven that the ball meets are kept.
#pragma once

#include <cstdint>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell::as_written {

inline constexpr int kIdBits = 32;
inline constexpr int kMaxPhantoms = 7;

OCTOCELL_HD float cell_side(float r_max) { return 1.5F * r_max; }

/// Converts float to unsigned as CUDA does: toward zero, saturating. 0/0 (all radii are zero) gives
/// 0.
OCTOCELL_HD std::uint32_t saturated(float value) {
  if (!(value > 0.0F)) return 0;
  return value >= 4294967296.0F ? 0xffffffffU : static_cast<std::uint32_t>(value);
}

struct Coordinates {
  std::uint32_t x;
  std::uint32_t y;
  std::uint32_t z;
};

OCTOCELL_HD Coordinates home(const Sphere& s, float side) {
  return {saturated(s.x / side), saturated(s.y / side), saturated(s.z / side)};
}

OCTOCELL_HD std::uint32_t hash(Coordinates c) { return c.x | c.y << 10 | c.z << 20; }

/// Returns the distance from p to the slab [c * side, (c + 1) * side].
OCTOCELL_HD float gap(float p, std::uint32_t c, float side) {
  const float low = static_cast<float>(c) * side;
  const float high = low + side;
  if (p < low) return low - p;
  return p > high ? p - high : 0.0F;
}

OCTOCELL_HD bool ball_meets(const Sphere& s, Coordinates c, float side) {
  const float gx = gap(s.x, c.x, side);
  const float gy = gap(s.y, c.y, side);
  const float gz = gap(s.z, c.z, side);
  return gx * gx + gy * gy + gz * gz <= s.r * s.r;
}

/// Calls put(id) for each phantom cell, at most seven times.
template <typename Put>
OCTOCELL_HD void for_each_phantom(const Sphere& s, float side, Put put) {
  const Coordinates c = home(s, side);
  int listed = 0;
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    const int dx = neighbour % 3 - 1;
    const int dy = neighbour / 3 % 3 - 1;
    const int dz = neighbour / 9 - 1;
    if (dx == 0 && dy == 0 && dz == 0) continue;
    // An unsigned grid has no cells below zero, and none above its last.
    const auto outside = [](std::uint32_t at, int step) {
      return step < 0 ? at == 0 : step > 0 && at == 0xffffffffU;
    };
    if (outside(c.x, dx) || outside(c.y, dy) || outside(c.z, dz)) continue;
    const Coordinates there = {c.x + static_cast<std::uint32_t>(dx),
                               c.y + static_cast<std::uint32_t>(dy),
                               c.z + static_cast<std::uint32_t>(dz)};
    if (!ball_meets(s, there, side)) continue;
    put(hash(there));
    if (++listed == kMaxPhantoms) return;
  }
}

}  // namespace octocell::as_written
