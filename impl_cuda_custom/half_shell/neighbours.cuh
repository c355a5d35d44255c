// SPDX-License-Identifier: MIT
// Where the neighbours of a sphere lie among the sorted spheres: as runs of places, one for each
// row of columns. Each pair of spheres that may overlap lies in one run of one of the two, and in
// no other run.
//   In the sphere's own level: its own row from the sphere on, and four rows behind it. The spheres
//   of the four rows before it find this one, so together these are all rows around (half a
//   shell).
//   In each coarser level: nine rows of that level's grid, around the cell in which the sphere
//   lies.
#pragma once

#include <cstdint>

#include "core/half_shell.hpp"
#include "impl_cuda_custom/half_shell/cell_starts.cuh"

namespace octocell::cuda_custom::half_shell {

/// The levels and their sorted spheres, as stages 4 and 5 see them.
struct Shells {
  Levels levels;
  bool open[kMaxLevels];  // for each level; see is_open()
  bool rows_wrap;         // in some level
  CellStarts starts;
  const Sphere* spheres;  // sorted, with stored radii
  const Object* objects;  // their ids

  [[nodiscard]] __device__ int level_of_id(std::uint32_t id) const {
    int level = 0;
    while (level + 1 < levels.count && id >= levels.level[level + 1].first_id) ++level;
    return level;
  }

  /// Calls visit(run) for each run of the sphere at `place`, whose id is `id`. All lanes of a warp
  /// must call it, and they call visit() together. A lane without a sphere (not `present`) has
  /// empty runs.
  template <typename Visit>
  __device__ void visit_runs(bool present, std::uint32_t place, std::uint32_t id,
                             const Sphere& sphere, Visit visit) const;

  [[nodiscard]] __device__ std::uint64_t count_neighbours(bool present, std::uint32_t place,
                                                          std::uint32_t id,
                                                          const Sphere& sphere) const {
    std::uint64_t count = 0;
    visit_runs(present, place, id, sphere, [&](IndexRange run) { count += run.size(); });
    return count;
  }
};

/// Returns true if the borders of a level need no special case. Rows are then found only by
/// differences of ids. An id beyond a border belongs to the other end of the next row, whose
/// spheres are too far away to overlap. The differences are distinct for all columns of all rows
/// around, so each pair of ids is met once. That needs more columns than a run has, at least three
/// rows, and no wrapped axis.
inline bool is_open(const Level& level) {
  return !level.grid.wraps() && level.grid.stride_y > 2 * level.column_reach &&
         level.grid.period(1) >= 3;
}

/// Returns the columns from `back` before that of `id` to column_reach behind it. For an open
/// level.
__device__ inline IndexRange open_run(const CellStarts& starts, const Level& level,
                                      std::uint32_t id, RowStep step, std::uint32_t back) {
  const auto first = std::int64_t{level.first_id};
  const std::int64_t end = first + level.ids;
  const std::int64_t there = std::int64_t{id} + step.y * std::int64_t{level.grid.stride_y} +
                             step.z * std::int64_t{level.grid.stride_z};
  const auto within = [&](std::int64_t wanted) {
    return static_cast<std::uint32_t>(min(max(wanted, first), end));
  };
  return {starts.place_of(within(there - back)),
          starts.place_of(within(there + level.column_reach + 1))};
}

/// Returns a cell's coordinates from its id; on a wrapped axis they lie within its period.
__device__ inline Cell cell_of_id(const Level& level, std::uint32_t id) {
  const std::uint32_t columns = level.grid.stride_y;
  const std::uint32_t rows = level.grid.period(1);
  const std::uint32_t row = (id - level.first_id) / columns;
  const std::uint32_t layer = row / rows;
  return {id - level.first_id - row * columns, row - layer * rows, layer};
}

/// Returns the same run for any level. `around` selects the part beyond the border of a row that
/// wraps; it is empty except for columns near that border.
__device__ inline IndexRange bordered_run(const CellStarts& starts, const Level& level,
                                          std::uint32_t id, RowStep step, std::uint32_t back,
                                          bool around) {
  const Grid& grid = level.grid;
  Cell cell = cell_of_id(level, id);
  if (!step_along(grid, 1, step.y, cell.y) || !step_along(grid, 2, step.z, cell.z)) return {};
  const std::uint32_t columns = grid.stride_y;
  const std::uint32_t row = level.first_id + grid.stride_y * cell.y + grid.stride_z * cell.z;
  const auto run = [&](std::uint32_t first, std::uint32_t end) {
    return IndexRange{starts.place_of(row + first), starts.place_of(row + end)};
  };
  const std::uint32_t end = cell.x + level.column_reach + 1;
  if (!around) return run(cell.x < back ? 0 : cell.x - back, min(end, columns));
  if (grid.wrap_mask[0] == ~0U) return {};
  if (end > columns) return run(0, end - columns);
  return cell.x < back ? run(cell.x + columns - back, columns) : IndexRange{};
}

/// Calls visit(run_of(k)) for k below `count`. Looks up each run before it visits the previous one,
/// so that the two overlap.
template <typename RunOf, typename Visit>
__device__ void visit_each(int count, RunOf run_of, Visit visit) {
  IndexRange next = run_of(0);
#pragma unroll 1
  for (int k = 1; k <= count; ++k) {
    const IndexRange now = next;
    if (k < count) next = run_of(k);
    visit(now);
  }
}

template <typename Visit>
__device__ void Shells::visit_runs(bool present, std::uint32_t place, std::uint32_t id,
                                   const Sphere& sphere, Visit visit) const {
  const auto visit_rows = [&](int rows, auto run_of) {
    visit_each(
        rows_wrap ? 2 * rows : rows,
        [&](int k) { return run_of(k < rows ? k : k - rows, k >= rows); }, visit);
  };
  const auto run_in = [&](int k, std::uint32_t of_id, RowStep step, std::uint32_t back,
                          bool around) {
    const Level& level = levels.level[k];
    if (!open[k]) return bordered_run(starts, level, of_id, step, back, around);
    return around ? IndexRange{} : open_run(starts, level, of_id, step, back);
  };

  const int own = level_of_id(id);
  visit_rows(kShellRows, [&](int row, bool around) {
    if (!present) return IndexRange{};
    const std::uint32_t back = row == 0 ? 0 : levels.level[own].column_reach;
    IndexRange run = run_in(own, id, shell_row(row), back, around);
    if (row == 0 && !around) run.begin = place + 1;
    return run;
  });
  for (int k = 1; k < levels.count; ++k) {
    const Level& coarser = levels.level[k];
    const bool below = present && own < k;
    const std::uint32_t there =
        below ? coarser.first_id +
                    cell_id(coarser.grid, cell_of(coarser.grid, sphere.x, sphere.y, sphere.z))
              : 0;
    visit_rows(kRowsAround, [&](int row, bool around) {
      return below ? run_in(k, there, row_around(row), coarser.column_reach, around) : IndexRange{};
    });
  }
}

/// The common case: a single, open level. Its runs follow from an id by a few additions.
struct OpenLevel {
  std::uint32_t ids;
  std::uint32_t column_reach;
  std::uint32_t row;    // from the id of a cell to that of its neighbour in y
  std::uint32_t layer;  // the same in z
  CellStarts starts;
  const Sphere* spheres;
  const Object* objects;

  [[nodiscard]] __device__ IndexRange run_of(int k, std::uint32_t place, std::uint32_t id) const {
    const RowStep step = shell_row(k);
    const std::uint32_t there = id + step.y * row + step.z * layer;
    const std::uint32_t end = starts.place_of(min(there + column_reach + 1, ids));
    return {k == 0 ? place + 1 : starts.place_of(min(there - column_reach, ids)), end};
  }

  template <typename Visit>
  __device__ void visit_runs(bool present, std::uint32_t place, std::uint32_t id, const Sphere&,
                             Visit visit) const {
    visit_each(
        kShellRows, [&](int k) { return present ? run_of(k, place, id) : IndexRange{}; }, visit);
  }

  [[nodiscard]] __device__ std::uint64_t count_neighbours(bool present, std::uint32_t place,
                                                          std::uint32_t id, const Sphere&) const {
    std::uint64_t count = 0;
#pragma unroll
    for (int k = 0; k < kShellRows; ++k) {
      if (present) count += run_of(k, place, id).size();
    }
    return count;
  }
};

inline Shells shells_of(Workspace& w, const CellStarts& starts) {
  Shells shells = {.levels = w.levels(),
                   .open = {},
                   .rows_wrap = false,
                   .starts = starts,
                   .spheres = w.sorted_spheres.data(),
                   .objects = w.sorted().values};
  for (int k = 0; k < w.levels().count; ++k) {
    const Level& level = w.levels().level[k];
    shells.open[k] = is_open(level);
    shells.rows_wrap = shells.rows_wrap || level.grid.wrap_mask[0] != ~0U;
  }
  return shells;
}

inline OpenLevel open_level_of(Workspace& w, const CellStarts& starts) {
  const Level& level = w.levels().level[0];
  return {.ids = level.ids,
          .column_reach = level.column_reach,
          .row = level.grid.stride_y,
          .layer = level.grid.stride_z,
          .starts = starts,
          .spheres = w.sorted_spheres.data(),
          .objects = w.sorted().values};
}

/// Calls run(neighbours) with Shells or OpenLevel, whichever the plan needs.
template <typename WithNeighbours>
void with_neighbours(Workspace& w, WithNeighbours run) {
  const CellStarts starts = starts_of(w);
  const bool one_open_level = w.levels().count == 1 && is_open(w.levels().level[0]);
  if (one_open_level) return run(open_level_of(w, starts));
  run(shells_of(w, starts));
}

}  // namespace octocell::cuda_custom::half_shell
