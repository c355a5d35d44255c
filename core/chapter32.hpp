// SPDX-License-Identifier: MIT
// Rule chapter32: GPU Gems 3, chapter 32 (Le Grand), with boxes instead of balls.
//
// Spheres are scaled by sqrt 2, so that of two that overlap, at least one extents the other's home
// cell; cells are 1.5 scaled diameters wide, so that parity tells neighbours apart where it must.
// A pair is tested in a cell that is home to one of the two, once (docs/exactness.md, claim C).
#pragma once

#include <cstdint>

#include "core/faults.hpp"
#include "core/grid.hpp"

namespace octocell::chapter32 {

inline constexpr float kScale = 0x1.6a09eap0F;  // the next float but one above sqrt 2, so that
                                                // fl(kScale * r) >= sqrt 2 * r over the reals
                                                // (subnormal r: docs/exactness.md, claim C)

OCTOCELL_HD float extent(float r) {
  return r * OCTOCELL_FAULT(chapter32_extent_rounded_down, 0x1.6a09e6p0F, kScale);
}

/// 3 sqrt 2 r_max, rounded up.
inline double cell_side(float r_max) { return 4.2426406871192861 * static_cast<double>(r_max); }

/// One of eight: the parities of the cell's coordinates.
OCTOCELL_HD std::uint32_t cell_type(Cell cell) {
  return (cell.x & 1U) | (cell.y & 1U) << 1 | (cell.z & 1U) << 2;
}

/// Bits 0..2: the home cell's type. Bits 3..10: the types of all cells met, one bit each.
using ControlBits = std::uint16_t;

OCTOCELL_HD ControlBits control_bits_of(const CellRange& met, Cell home) {
  std::uint32_t types = 0;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const Cell cell = {(corner & 1U) != 0 ? met.highest.x : met.lowest.x,
                       (corner & 2U) != 0 ? met.highest.y : met.lowest.y,
                       (corner & 4U) != 0 ? met.highest.z : met.lowest.z};
    types |= 1U << cell_type(cell);
  }
  return static_cast<ControlBits>(types << 3 | cell_type(home));
}

/// The rule holds only for spheres that meet at most two cells on each axis: parity tells no more.
OCTOCELL_HD bool meets_three_cells(const CellRange& met) {
  return met.highest.x - met.lowest.x > 1 || met.highest.y - met.lowest.y > 1 ||
         met.highest.z - met.lowest.z > 1;
}
inline constexpr const char* kMeetsThreeCells =
    "rule chapter32: a sphere meets three cells on one axis";

/// The rule: may this pair be tested in a cell of type `type`?  Not where both are phantoms (the
/// caller sees to that), and not where a home of lower type, which both of them meet, comes first.
OCTOCELL_HD bool tests_pair_here(std::uint32_t type, ControlBits a, ControlBits b) {
  const std::uint32_t met_by_both = (a & b) >> 3;
  const std::uint32_t home_a = a & 7U;
  const std::uint32_t home_b = b & 7U;
  const bool earlier_a = home_a < type && (met_by_both >> home_a & 1U) != 0;
  const bool earlier_b = OCTOCELL_FAULT(chapter32_counts_twice, false,
                                        home_b < type && (met_by_both >> home_b & 1U) != 0);
  return !earlier_a && !earlier_b;
}

}  // namespace octocell::chapter32
