// SPDX-License-Identifier: MIT
// Where the partners of a sphere lie.
//
// Spheres of a level that overlap lie in adjacent cells of its grid. So do a sphere and one of a
// coarser level, in the coarser grid: their centres differ by at most r + r' <= 2 r', the side of a
// cell (docs/exactness.md, claim A). One sphere of each pair searches for the other: within a
// level, the one that has the other in its half shell; otherwise the finer one, because all
// partners of a giant sphere would be the work of one work item.
#pragma once

#include <cstdint>

#include "core/half_shell.hpp"
#include "impl_thrust/half_shell/half_shell.cuh"

namespace octocell::on_thrust::half_shell {

/// The columns near a sphere in one row.
struct Window {
  IndexRange near;
  IndexRange across;  // what lies beyond the seam of a wrapped axis
};

/// Returns the cell of a centre as ids number it.
OCTOCELL_HD Cell wrapped_cell(const Grid& grid, const Sphere& s) {
  const Cell cell = cell_of(grid, s.x, s.y, s.z);
  return {cell.x & grid.wrap_mask[0], cell.y & grid.wrap_mask[1], cell.z & grid.wrap_mask[2]};
}

struct Shell {
  const Levels* levels;
  const std::uint32_t* ids;  // sorted
  const Sphere* members;     // in the same order
  const ColumnRow* rows;     // [row_count + 1]
  std::uint32_t row_count;

  /// Calls visit(run) for runs that together hold each partner that sphere k must search for, and
  /// no sphere twice.
  template <typename Visit>
  OCTOCELL_HD void for_each_run(std::uint32_t k, Visit visit) const {
    const int own = level_of_id(*levels, ids[k]);
    for (int l = own; l < levels->count; ++l) {
      const Level& level = levels->level[l];
      const Cell cell = wrapped_cell(level.grid, members[k]);
      const int steps = l == own ? kShellRows : kRowsAround;
      for (int s = 0; s < steps; ++s) {
        const RowStep step = l == own ? shell_row(s) : row_around(s);
        const ColumnRow* const row = row_at(level, cell, step);
        if (row == nullptr) continue;
        const bool within_row = l == own && s == 0;
        const Window window =
            within_row ? window_behind(level, *row, cell.x, k) : window_around(level, *row, cell.x);
        visit(window.near);
        visit(window.across);
      }
    }
  }

 private:
  /// Returns the row y and z cells away from `cell`; null if that row has no spheres or does not
  /// exist.
  [[nodiscard]] OCTOCELL_HD const ColumnRow* row_at(const Level& level, Cell cell,
                                                    RowStep step) const {
    const Grid& grid = level.grid;
    if (!step_along(grid, 1, step.y, cell.y) || !step_along(grid, 2, step.z, cell.z))
      return nullptr;
    const std::uint32_t first_id = level.first_id + grid.stride_y * cell.y + grid.stride_z * cell.z;
    const std::uint32_t at =
        first_not(0, row_count, [&](std::uint32_t r) { return rows[r].first_id < first_id; });
    return at < row_count && rows[at].first_id == first_id ? rows + at : nullptr;
  }

  /// Returns the spheres of a row in columns [first, last].
  [[nodiscard]] OCTOCELL_HD IndexRange in_columns(const ColumnRow& row, std::uint32_t first,
                                                  std::uint32_t last) const {
    const std::uint32_t row_end = (&row + 1)->begin;
    const std::uint32_t begin = first_not(
        row.begin, row_end, [&](std::uint32_t i) { return ids[i] < row.first_id + first; });
    const std::uint32_t end =
        first_not(begin, row_end, [&](std::uint32_t i) { return ids[i] <= row.first_id + last; });
    return {begin, end};
  }

  /// Returns true if the period is so short that both ends of a window meet: then all columns are
  /// near.
  [[nodiscard]] OCTOCELL_HD static bool all_near(const Level& level) {
    return level.grid.wraps(0) && level.grid.period(0) <= 2 * level.column_reach;
  }

  /// Returns the columns from level.column_reach before `column` to level.column_reach behind it.
  [[nodiscard]] OCTOCELL_HD Window window_around(const Level& level, const ColumnRow& row,
                                                 std::uint32_t column) const {
    const std::uint32_t columns = level.grid.period(0);
    if (all_near(level)) return {{row.begin, (&row + 1)->begin}, {0, 0}};
    const bool before_first = column < level.column_reach;
    const bool behind_last = column + level.column_reach >= columns;
    Window window = {in_columns(row, before_first ? 0 : column - level.column_reach,
                                behind_last ? columns - 1 : column + level.column_reach),
                     {0, 0}};
    if (!level.grid.wraps(0)) return window;
    if (before_first)
      window.across = in_columns(row, columns + column - level.column_reach, columns - 1);
    if (behind_last) window.across = in_columns(row, 0, column + level.column_reach - columns);
    return window;
  }

  /// Returns the spheres of its own row that follow sphere k, up to level.column_reach columns
  /// behind it.
  [[nodiscard]] OCTOCELL_HD Window window_behind(const Level& level, const ColumnRow& row,
                                                 std::uint32_t column, std::uint32_t k) const {
    const std::uint32_t columns = level.grid.period(0);
    if (all_near(level)) return {{k + 1, (&row + 1)->begin}, {0, 0}};
    const bool behind_last = column + level.column_reach >= columns;
    const IndexRange near =
        in_columns(row, column, behind_last ? columns - 1 : column + level.column_reach);
    Window window = {{k + 1, near.end}, {0, 0}};
    if (behind_last && level.grid.wraps(0)) {
      window.across = in_columns(row, 0, column + level.column_reach - columns);
    }
    return window;
  }
};

/// Needs a workspace after stage 4.
template <typename System>
Shell shell_of(Workspace<System>& w) {
  return {w.levels, w.cell_ids.data(), w.members.data(), w.rows.data(),
          static_cast<std::uint32_t>(w.cell_count)};
}

}  // namespace octocell::on_thrust::half_shell
