// SPDX-License-Identifier: MIT
// The cell formula: from a coordinate to a cell, in fixed point, without an epsilon.
//
// A unit is a power of two, 2^k; a cell side is a whole number of units. Multiplying a float by
// 2^-k and taking the floor is exact, except for a negative product that is too small for a float:
// it counts as zero, which harms neither claim. So claims about cells are claims about integers:
//   monotone:  x <= y  =>  cell(x) <= cell(y)                 (any rounding of x and y is harmless)
//   Lipschitz: |x - y| <= cell side  =>  cells differ by <= 1 (docs/exactness.md, claims A and B)
// Coordinates outside the grid's box are clamped to its border cells; both claims still hold, for
// any box.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell {

/// Units are counted below 2^30. With b = 31 + ceil(log2 m), X * ceil(2^b / m) >> b is floor(X / m)
/// exactly and stays below 2^63 (Granlund and Montgomery, PLDI 1994, theorem 4.2).
inline constexpr int kReciprocalBits = 31;
inline constexpr double kMaxUnits = 1073741823.0;  // 2^30 - 1
inline constexpr std::uint32_t kMaxUnitsPerCell = 256;

struct Cell {
  std::uint32_t x;
  std::uint32_t y;
  std::uint32_t z;
};

/// How an axis is cut into cells.
struct CellWidth {
  std::uint32_t units = 1;                                         // m, 1..kMaxUnitsPerCell
  int reciprocal_bits = kReciprocalBits;                           // b
  std::uint64_t reciprocal = std::uint64_t{1} << kReciprocalBits;  // ceil(2^b / m)
};

struct Grid {
  float units_per_length = 1.0F;     // 2^-k
  double first_unit[3] = {0, 0, 0};  // floor(lowest corner * 2^-k)
  double last_unit[3] = {0, 0, 0};   // of the box, relative to first_unit; <= kMaxUnits
  CellWidth width[3];  // equal on all axes, except for the columns of method half_shell
  std::uint32_t cell_count[3] = {1, 1, 1};       // cells along each axis before wrapping
  std::uint32_t wrap_mask[3] = {~0U, ~0U, ~0U};  // period - 1 on a wrapped axis, all ones elsewhere
  std::uint32_t stride_y = 1;                    // ids: x + stride_y * y + stride_z * z
  std::uint32_t stride_z = 1;
  int key_bits = 0;        // every id is below 2^key_bits
  double cell_side = 1.0;  // along y and z: m * 2^k

  /// Returns the number of cells along an axis before ids repeat.
  [[nodiscard]] OCTOCELL_HD std::uint32_t period(int axis) const {
    return wraps(axis) ? wrap_mask[axis] + 1 : cell_count[axis];
  }
  [[nodiscard]] OCTOCELL_HD bool wraps(int axis) const { return wrap_mask[axis] != ~0U; }
  /// Returns true if an id may stand for several cells, which are always far apart; see
  /// make_grid().
  [[nodiscard]] bool wraps() const { return wraps(0) || wraps(1) || wraps(2); }
};

/// Returns the cell index along one axis. `value` may be infinite (p + r beyond FLT_MAX), but not
/// NaN.
OCTOCELL_HD std::uint32_t cell_coordinate(const Grid& grid, int axis, float value) {
  // Both terms are integers; inside the box their difference is below 2^30, hence exact.
  double unit = static_cast<double>(floorf(value * grid.units_per_length)) - grid.first_unit[axis];
  unit = unit < 0.0 ? 0.0 : unit;
  unit = unit > grid.last_unit[axis] ? grid.last_unit[axis] : unit;
  const auto whole = static_cast<std::uint64_t>(static_cast<std::int32_t>(unit));
  const CellWidth& width = grid.width[axis];
  return static_cast<std::uint32_t>((whole * width.reciprocal) >> width.reciprocal_bits);
}

OCTOCELL_HD std::uint32_t cell_id(const Grid& grid, Cell cell) {
  return (cell.x & grid.wrap_mask[0]) + grid.stride_y * (cell.y & grid.wrap_mask[1]) +
         grid.stride_z * (cell.z & grid.wrap_mask[2]);
}

OCTOCELL_HD Cell cell_of(const Grid& grid, float x, float y, float z) {
  return {cell_coordinate(grid, 0, x), cell_coordinate(grid, 1, y), cell_coordinate(grid, 2, z)};
}

/// The cells that a sphere's box meets, from lowest to highest, inclusive.
struct CellRange {
  Cell lowest;
  Cell highest;
};

/// Returns the number of cells of the range, without the home cell.
OCTOCELL_HD std::uint64_t phantoms_in(const CellRange& met) {
  return std::uint64_t{met.highest.x - met.lowest.x + 1} * (met.highest.y - met.lowest.y + 1) *
             (met.highest.z - met.lowest.z + 1) -
         1;
}

OCTOCELL_HD CellRange cells_met(const Grid& grid, const Sphere& s, float extent) {
  return {cell_of(grid, s.x - extent, s.y - extent, s.z - extent),
          cell_of(grid, s.x + extent, s.y + extent, s.z + extent)};
}

}  // namespace octocell
