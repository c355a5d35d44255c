// SPDX-License-Identifier: MIT
// What every grid backend sorts, and what its cell index holds.
#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "core/sphere.hpp"

namespace octocell {

/// The sorted value: a sphere's id with four control bits above it.
///   bit 31      this cell is a phantom cell of the sphere
///   bits 28-30  per axis (x, y, z): this cell is the lowest one that the sphere meets
using Object = std::uint32_t;
inline constexpr int kLowestShift = 28;
inline constexpr Object kIdMask = (1U << kLowestShift) - 1;
inline constexpr Object kLowestMask = 7U << kLowestShift;
inline constexpr Object kPhantom = 1U << 31;
static_assert(kMaxSpheres == kIdMask + 1ULL);

/// Returns a sphere's word in `cell`, without kPhantom. `lowest` is the lowest cell that the sphere
/// meets.
OCTOCELL_HD Object object_of(std::uint32_t sphere, Cell cell, Cell lowest) {
  const Object at_lowest = (cell.x == lowest.x ? 1U : 0U) | (cell.y == lowest.y ? 2U : 0U) |
                           (cell.z == lowest.z ? 4U : 0U);
  return sphere | at_lowest << kLowestShift;
}

/// A run of the sorted arrays: one cell's homes, then its phantoms.
struct CellEntry {
  std::uint32_t begin;
  std::uint32_t homes;
  std::uint32_t phantoms;
};

}  // namespace octocell
