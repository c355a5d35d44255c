// SPDX-License-Identifier: MIT
#include "core/planner/cost_half_shell.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/digit_plan.hpp"
#include "core/planner/bulk.hpp"

namespace octocell {
namespace {

/// Returns the part of a row's spheres that are tested against the row one step along the axis.
double share_near_border(const Level& level, int axis, const ShellCosts& costs) {
  if (level.grid.cell_count[axis] == 1) return 0.0;
  if (!costs.near_borders) return 1.0;
  return std::min(1.0, 2.0 * static_cast<double>(level.r_max) / level.grid.cell_side);
}

/// Returns how long the columns are that may hold partners of a sphere, in cells.
double window_in_cells(const Level& level) {
  return (2.0 * level.column_reach + 1.0) / columns_per_cell(level.grid);
}

double cost_within(const Level& level, const Members& members, const Crowding& crowding,
                   const ShellCosts& costs) {
  const Grid& grid = level.grid;
  const double filled = 1.0 - std::exp(-members.count / rows_of_cells(grid));
  const double y = share_near_border(level, 1, costs);
  const double z = share_near_border(level, 2, costs);
  const double near_others = y + z + 2.0 * y * z;  // one row along y, one along z, two diagonal
  const double candidates =
      crowding.in_cell * window_in_cells(level) * (0.5 + y * y + z * z + 2.0 * y * y * z * z);
  return members.count * (costs.per_sphere + near_others * filled * costs.per_window +
                          candidates * costs.per_candidate) +
         crowding.filled_rows * costs.per_row +
         (grid.wraps() ? members.count * costs.per_wrapped : 0.0) +
         std::min<double>(level.ids, 8.0 * members.count) * costs.per_id;
}

/// Returns the cost of testing each sphere of the finer level against nine rows of the coarser
/// level.
double cost_of_finer(const Level& coarser, const Members& coarse, const Members& fine,
                     const ShellCosts& costs) {
  constexpr double kRows = 9.0;
  const double candidates = std::min(
      coarse.count, neighbours_in_cell(coarser, coarse) * window_in_cells(coarser) * kRows);
  return fine.count * (kRows * costs.per_probe + candidates * costs.per_candidate);
}

/// Returns the cost of testing each sphere of the coarse level against the finer one: the rows that
/// its box meets, and the spheres that its box holds.
double cost_of_coarser(const SceneStats& stats, const Members& coarse, const Level& level,
                       const Members& fine, const ShellCosts& costs) {
  const double width = 2.0 * (coarse.mean_radius() + static_cast<double>(level.r_max));
  double rows = 1.0;
  for (const int a : {1, 2}) {
    rows *= std::min<double>(level.grid.cell_count[a], width / level.grid.cell_side + 1.0);
  }
  double share = 1.0;
  for (int a = 0; a < 3; ++a) share *= share_of_axis(stats, a, width + level.grid.cell_side);
  return coarse.count *
         (std::min(rows, fine.count) * costs.per_probe + fine.count * share * costs.per_candidate);
}

/// Returns the part of the full cost for scenes that fit into caches: few spheres fit into the
/// nearest ones, many into none; in between, the logarithm decides.
double share_of_caches(std::uint64_t spheres, double in_cache) {
  constexpr double kFew = 2.0;  // powers of ten
  constexpr double kMany = 5.0;
  const double size = std::log10(static_cast<double>(std::max<std::uint64_t>(spheres, 1)));
  const double between = std::clamp((size - kFew) / (kMany - kFew), 0.0, 1.0);
  return in_cache + (1.0 - in_cache) * between;
}

}  // namespace

double cost_of(const Level& level, const Members& members, const Crowding& crowding,
               const Costs& costs) {
  const int key_bits = static_cast<int>(std::bit_width(level.ids - 1));
  return cost_within(level, members, crowding, costs.shell) +
         members.count * sort_passes(key_bits, costs.digit_bits) * costs.shell.per_pass;
}

double cost_across(const SceneStats& stats, const Level& coarser, const Members& coarse,
                   const Level& finer, const Members& fine, const ShellCosts& costs) {
  if (costs.finer_probe) return cost_of_finer(coarser, coarse, fine, costs);
  return cost_of_coarser(stats, coarse, finer, fine, costs);
}

double estimate_cost(const SceneStats& stats, const Levels& levels, int key_bits,
                     const Costs& costs) {
  double sum = static_cast<double>(stats.facts.sphere_count) *
               sort_passes(key_bits, costs.digit_bits) * costs.shell.per_pass;
  std::size_t next = 0;
  std::vector<Members> members;
  for (int k = 0; k < levels.count; ++k) {
    const std::size_t first = next;
    while (next < stats.radii.size() && stats.radii[next].largest <= levels.level[k].r_max) ++next;
    members.push_back(members_of(stats, {first, next}));
  }
  for (int fine = 0; fine < levels.count; ++fine) {
    const Level& level = levels.level[fine];
    sum += cost_within(level, members[fine], crowding_of(level, members[fine]), costs.shell);
    for (int coarse = fine + 1; coarse < levels.count; ++coarse) {
      sum += cost_across(stats, levels.level[coarse], members[coarse], level, members[fine],
                         costs.shell);
    }
  }
  return sum * share_of_caches(stats.facts.sphere_count, costs.shell.in_cache);
}

}  // namespace octocell
