// SPDX-License-Identifier: MIT
// Rule chapter32: GPU Gems 3, chapter 32 (Le Grand), with boxes instead of balls.
//
// Spheres are scaled by sqrt 2. Then, if two spheres overlap, at least one of them reaches into the
// other's home cell. Cells are 1.5 scaled diameters wide, so that the parity of coordinates
// distinguishes neighbours where it must. A pair is tested once, in a cell that is the home of one
// of the two (docs/exactness.md, claim C).
#pragma once

#include <cstdint>

#include "core/grid.hpp"

namespace octocell::chapter32 {

inline constexpr float kScale = 0x1.6a09eap0F;  // the second float above sqrt 2, so that fl(kScale
                                                // * r) >= sqrt 2 * r over the reals (subnormal r:
                                                // docs/exactness.md, claim C)

OCTOCELL_HD float extent(float r) { return r * kScale; }

/// Returns 3 sqrt 2 r_max, rounded up.
inline double cell_side(float r_max) { return 4.2426406871192861 * static_cast<double>(r_max); }

/// Returns one of eight types: the parities of the cell's coordinates.
OCTOCELL_HD std::uint32_t cell_type(Cell cell) {
  return (cell.x & 1U) | (cell.y & 1U) << 1 | (cell.z & 1U) << 2;
}

/// Bits 0..2: the type of the home cell. Bits 3..10: the types of all cells met, one bit each.
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

/// Returns true if the rule does not hold: parity can tell at most two cells per axis apart.
OCTOCELL_HD bool meets_three_cells(const CellRange& met) {
  return met.highest.x - met.lowest.x > 1 || met.highest.y - met.lowest.y > 1 ||
         met.highest.z - met.lowest.z > 1;
}
inline constexpr const char* kMeetsThreeCells =
    "rule chapter32: a sphere meets three cells on one axis";

/// The rule: returns true if this pair may be tested in a cell of type `type`. Another cell tests
/// it if a home of a lower type is met by both spheres. The caller leaves out pairs of two
/// phantoms.
OCTOCELL_HD bool tests_pair_here(std::uint32_t type, ControlBits a, ControlBits b) {
  const std::uint32_t met_by_both = (a & b) >> 3;
  const std::uint32_t home_a = a & 7U;
  const std::uint32_t home_b = b & 7U;
  const bool earlier_a = home_a < type && (met_by_both >> home_a & 1U) != 0;
  const bool earlier_b = home_b < type && (met_by_both >> home_b & 1U) != 0;
  return !earlier_a && !earlier_b;
}

}  // namespace octocell::chapter32
