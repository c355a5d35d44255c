// SPDX-License-Identifier: MIT
// Where the neighbours of a sphere lie among the sorted spheres: as runs of places, one a row of
// columns. Each pair of spheres that may overlap lies in one run of one of the two, and in one
// only.
//   Of the sphere's own level: its own row from the sphere on, and four rows behind it, which with
//   the four before it, whose spheres find this one, are all rows around (half of the shell).
//   Of each coarser level: nine rows of that level's grid, around the cell in which the sphere
//   lies.
#pragma once

#include "impl_cuda_custom/half_shell/cell_starts.cuh"

namespace octocell::cuda_custom::half_shell {

/// Places [begin, end) of the sorted spheres.
struct Run {
  std::uint32_t begin;
  std::uint32_t end;
  [[nodiscard]] __device__ std::uint32_t size() const { return end - begin; }
};

/// A row's part; the second is empty unless the row's border lies in it and the row wraps.
struct Runs {
  Run here;
  Run around;
};

/// The levels and the spheres sorted by them, as stages 4 and 5 look at them.
struct Shells {
  Levels levels;
  bool rows_wrap;  // in any level
  CellStarts starts;
  const Sphere* spheres;  // sorted, with band radii
  const Object* objects;  // their ids

  [[nodiscard]] __device__ int level_of_id(std::uint32_t id) const {
    int level = 0;
    while (level + 1 < levels.count && id >= levels.level[level + 1].first_id) ++level;
    return level;
  }
};

/// A cell's coordinates as its id has them: those of a wrapped axis lie within its period.
__device__ inline Cell cell_of_id(const Level& level, std::uint32_t id) {
  const std::uint32_t columns = level.grid.stride_y;
  const std::uint32_t rows = level.grid.period(1);
  const std::uint32_t row = (id - level.first_id) / columns;
  const std::uint32_t layer = row / rows;
  return {id - level.first_id - row * columns, row - layer * rows, layer};
}

/// Takes a coordinate to its neighbour, -1, 0 or 1 further on; false where the axis ends.
__device__ inline bool step_along(const Grid& grid, int axis, int step, std::uint32_t& coordinate) {
  coordinate += static_cast<std::uint32_t>(step);
  if (coordinate < grid.period(axis)) return true;
  if (grid.wrap_mask[axis] == ~0U) return false;
  coordinate &= grid.wrap_mask[axis];
  return true;
}

/// The columns from `back` before cell.x to the level's reach behind it.
__device__ inline Runs runs_in_row(const CellStarts& starts, const Level& level, Cell cell,
                                   std::uint32_t back) {
  const Grid& grid = level.grid;
  const std::uint32_t columns = grid.stride_y;
  const std::uint32_t row = level.first_id + grid.stride_y * cell.y + grid.stride_z * cell.z;
  const auto run = [&](std::uint32_t first, std::uint32_t end) {
    return Run{starts.place_of(row + first), starts.place_of(row + end)};
  };
  const std::uint32_t end = cell.x + level.reach + 1;
  const bool ends_behind = end > columns;
  const bool begins_before = cell.x < back;
  const bool wraps = grid.wrap_mask[0] != ~0U;
  Runs runs = {run(begins_before ? 0 : cell.x - back, ends_behind ? columns : end), {0, 0}};
  if (wraps && ends_behind) runs.around = run(0, end - columns);
  if (wraps && begins_before) runs.around = run(cell.x + columns - back, columns);
  return runs;
}

/// Rows of the half shell: 0 is the sphere's own, then (y, z) + (1, 0), (-1, 1), (0, 1), (1, 1).
constexpr int kShellRows = 5;

__device__ inline Runs runs_of_level(const Shells& shells, const Level& level, Cell cell,
                                     std::uint32_t place, int row) {
  if (row == 0) {
    Runs runs = runs_in_row(shells.starts, level, cell, 0);
    runs.here.begin = place + 1;
    return runs;
  }
  if (!step_along(level.grid, 1, row == 1 ? 1 : row - 3, cell.y)) return {};
  if (row > 1 && !step_along(level.grid, 2, 1, cell.z)) return {};
  return runs_in_row(shells.starts, level, cell, level.reach);
}

constexpr int kRowsAround = 9;

__device__ inline Runs runs_of_coarser_level(const Shells& shells, const Level& level, Cell cell,
                                             int row) {
  if (!step_along(level.grid, 1, row % 3 - 1, cell.y)) return {};
  if (!step_along(level.grid, 2, row / 3 - 1, cell.z)) return {};
  return runs_in_row(shells.starts, level, cell, level.reach);
}

__device__ inline Cell wrapped_cell(const Grid& grid, const Sphere& s) {
  const Cell cell = cell_of(grid, s.x, s.y, s.z);
  return {cell.x & grid.wrap_mask[0], cell.y & grid.wrap_mask[1], cell.z & grid.wrap_mask[2]};
}

/// Calls visit(run) for each run of the sphere at `place`, whose id is `id`. All lanes of a warp
/// call it, and visit() is called by all of them together; a lane without a sphere (not `present`)
/// has empty runs. The next run is looked up before one is visited, so that the two overlap.
template <typename Visit>
__device__ void visit_runs(const Shells& shells, bool present, std::uint32_t place,
                           std::uint32_t id, const Sphere& sphere, Visit visit) {
  const auto visit_rows = [&](int rows, auto runs_of_row) {
    Runs next = runs_of_row(0);
#pragma unroll 1
    for (int row = 1; row <= rows; ++row) {
      const Runs now = next;
      next = row < rows ? runs_of_row(row) : Runs{};
      visit(now.here);
      if (shells.rows_wrap) visit(now.around);
    }
  };
  const int own = shells.level_of_id(id);
  const Level& level = shells.levels.level[own];
  const Cell cell = present ? cell_of_id(level, id) : Cell{};
  visit_rows(kShellRows, [&](int row) {
    return present ? runs_of_level(shells, level, cell, place, row) : Runs{};
  });
  for (int k = 1; k < shells.levels.count; ++k) {
    const Level& coarser = shells.levels.level[k];
    const bool below = present && own < k;
    const Cell there = below ? wrapped_cell(coarser.grid, sphere) : Cell{};
    visit_rows(kRowsAround, [&](int row) {
      return below ? runs_of_coarser_level(shells, coarser, there, row) : Runs{};
    });
  }
}

inline Shells shells_of(Workspace& w) {
  const IdArrays& sorted = w.sorted();
  bool rows_wrap = false;
  for (int k = 0; k < w.plan.levels.count; ++k) {
    rows_wrap = rows_wrap || w.plan.levels.level[k].grid.wrap_mask[0] != ~0U;
  }
  return {.levels = w.plan.levels,
          .rows_wrap = rows_wrap,
          .starts = {.cell_ids = sorted.cell_ids.data(),
                     .starts = w.cell_starts.data(),
                     .shift = starts_shape(w.plan).shift},
          .spheres = w.sorted_spheres.data(),
          .objects = sorted.objects.data()};
}

}  // namespace octocell::cuda_custom::half_shell
