// SPDX-License-Identifier: MIT
// Method half_shell, as every backend sees it: the rows of columns that spheres lie in, and which
// rows around its own a sphere looks for partners in.
#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "core/host_device.hpp"

namespace octocell {

/// The spheres of a level with the same y and z cell: a row of columns along x.
struct ColumnRow {
  std::uint32_t first_id;  // of its column 0
  std::uint32_t begin;     // index of its first sphere; its spheres end where those of the next row
                           // begin
};

/// [begin, end): of spheres in the order of their columns, or of columns.
struct IndexRange {
  std::uint32_t begin;
  std::uint32_t end;
  [[nodiscard]] OCTOCELL_HD bool empty() const { return begin >= end; }
  [[nodiscard]] OCTOCELL_HD std::uint32_t size() const { return end - begin; }
};

/// The position of a row relative to that of a cell.
struct RowStep {
  int y;
  int z;
};

/// The half shell: a sphere's own row is row 0, and rows 1 to 4 are half of the eight around it. Of
/// two adjacent rows, exactly one has the other in its half.
inline constexpr int kShellRows = 5;
OCTOCELL_HD RowStep shell_row(int k) {
  return k < 2 ? RowStep{k, 0} : RowStep{k - 3, 1};  // (0, 0), (1, 0), (-1, 1), (0, 1), (1, 1)
}

/// The whole shell: spheres of a coarser level do not search for their finer partners.
inline constexpr int kRowsAround = 9;
OCTOCELL_HD RowStep row_around(int k) { return {k % 3 - 1, k / 3 - 1}; }

/// Moves a coordinate by -1, 0 or 1; returns false if the axis ends there.
OCTOCELL_HD bool step_along(const Grid& grid, int axis, int step, std::uint32_t& coordinate) {
  coordinate += static_cast<std::uint32_t>(step);
  if (coordinate < grid.period(axis)) return true;
  if (!grid.wraps(axis)) return false;
  coordinate &= grid.wrap_mask[axis];
  return true;
}

}  // namespace octocell
