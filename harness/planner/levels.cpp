// SPDX-License-Identifier: MIT
// Which size classes does half_shell need, and how large are their cells?  Any choice is correct
// whose cells are a diameter wide, so cost decides: one level for spheres of like size, one more
// where a few large ones would make the cells of all others too large.
#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "harness/planner/planner.hpp"

namespace octocell {
namespace {

/// Where the radii are cut: the largest radius of each level but the last.
using Cuts = std::vector<float>;

/// What of the scene belongs to one level.
struct Members {
  double count = 0.0;
  double r_sum = 0.0;
  std::vector<Sphere> sample;
  [[nodiscard]] double mean_radius() const { return count == 0.0 ? 0.0 : r_sum / count; }
};

std::vector<Members> divide(const SceneStats& stats, const Levels& levels) {
  std::vector<Members> members(static_cast<std::size_t>(levels.count));
  for (const RadiusClass& radii : stats.radii) {
    Members& m = members[level_of(levels, radii.largest)];
    m.count += static_cast<double>(radii.count);
    m.r_sum += radii.radius_sum;
  }
  for (const Sphere& s : stats.sample) members[level_of(levels, s.r)].sample.push_back(s);
  return members;
}

double cells_of(const Level& level) { return static_cast<double>(level.ids) / level.reach; }

/// Pairs of the sample that share a block of 2^shift cells a side.
std::uint64_t pairs_in_blocks(const Level& level, const std::vector<Sphere>& sample, int shift) {
  std::vector<std::uint64_t> blocks;
  for (const Sphere& s : sample) {
    const Cell cell = cell_of(level.grid, s.x, s.y, s.z);
    blocks.push_back(
        cell_id(level.grid, {(cell.x / level.reach) >> shift, cell.y >> shift, cell.z >> shift}));
  }
  std::ranges::sort(blocks);
  std::uint64_t pairs = 0;
  std::uint64_t alike = 0;
  for (std::size_t k = 1; k < blocks.size(); ++k) {
    alike = blocks[k] == blocks[k - 1] ? alike + 1 : 0;
    pairs += alike;
  }
  return pairs;
}

/// Spheres of the level in a cell around one of them: as if spread evenly, or as the sample says.
/// That is small, so it is asked for blocks of cells, the smallest in which enough of it meet.
double neighbours_in_cell(const Level& level, const Members& members) {
  constexpr std::uint64_t kEnough = 100;
  const double evenly = members.count / cells_of(level);
  const auto size = static_cast<double>(members.sample.size());
  const Grid& grid = level.grid;
  const std::uint32_t cells[3] = {grid.cell_count[0] / level.reach + 1, grid.cell_count[1],
                                  grid.cell_count[2]};
  const std::uint32_t most = std::max({cells[0], cells[1], cells[2]});
  for (int shift = 0; size > 1 && most >> shift != 0; ++shift) {
    const std::uint64_t pairs = pairs_in_blocks(level, members.sample, shift);
    if (pairs < kEnough) continue;
    double block = 1.0;  // cells
    for (const std::uint32_t n : cells) block *= std::min<double>(n, std::ldexp(1.0, shift));
    return std::max(evenly, 2.0 * static_cast<double>(pairs) / size * members.count / size / block);
  }
  return evenly;
}

double cost_within(const Level& level, const Members& members, const ShellCosts& costs) {
  const Grid& grid = level.grid;
  const double rows_of_cells = static_cast<double>(grid.period(1)) * grid.period(2);
  const double rows = std::min(members.count, rows_of_cells);
  const double neighbour_rows = (grid.cell_count[1] > 1 ? 1.0 : 0.0) +
                                (grid.cell_count[2] > 1 ? 1.0 : 0.0) +
                                (grid.cell_count[1] > 1 && grid.cell_count[2] > 1 ? 2.0 : 0.0);
  const double window_cells = 2.0 + 1.0 / level.reach;
  const double candidates =
      neighbours_in_cell(level, members) * window_cells * (0.5 + neighbour_rows);
  return members.count * (costs.per_sphere + neighbour_rows * costs.per_window +
                          candidates * costs.per_candidate) +
         rows * costs.per_row + std::min<double>(level.ids, 8.0 * members.count) * costs.per_id;
}

/// The part of an axis that a box of that width covers.
double share_of(const PlanFacts& facts, int axis, double width) {
  const double extent = static_cast<double>(facts.highest[axis]) - facts.lowest[axis];
  return extent > width ? width / extent : 1.0;
}

/// Each sphere of the finer level against the nine rows around it of the coarser.
double cost_of_finer(const Level& coarser, const Members& coarse, const Members& fine,
                     const ShellCosts& costs) {
  constexpr double kRows = 9.0;
  const double window_cells = 2.0 + 1.0 / coarser.reach;
  const double candidates =
      std::min(coarse.count, neighbours_in_cell(coarser, coarse) * window_cells * kRows);
  return fine.count * (kRows * costs.per_probe + candidates * costs.per_candidate);
}

/// Each sphere of the coarse level against the finer: the rows that its box meets, and in them
/// what its box holds.
double cost_of_coarser(const SceneStats& stats, const Members& coarse, const Level& level,
                       const Members& fine, const ShellCosts& costs) {
  const double width = 2.0 * (coarse.mean_radius() + static_cast<double>(level.r_max));
  double rows = 1.0;
  for (const int a : {1, 2}) {
    rows *= std::min<double>(level.grid.cell_count[a], width / level.grid.cell_side + 1.0);
  }
  double share = 1.0;
  for (int a = 0; a < 3; ++a) share *= share_of(stats.facts, a, width + level.grid.cell_side);
  return coarse.count *
         (std::min(rows, fine.count) * costs.per_probe + fine.count * share * costs.per_candidate);
}

/// The side and the number of columns with the least cost, for what spheres there are.
Level cheapest_level(const SceneStats& stats, float r_max, int most_bits, const Levels& so_far,
                     const Costs& costs) {
  Level best;
  double best_cost = HUGE_VAL;
  Levels trial = so_far;
  const auto index = trial.count++;
  double least = 2.0 * static_cast<double>(r_max);
  if (least == 0.0) least = std::max(mean_spacing(stats.facts) / 2.0, 0x1p-149);
  constexpr int kDoublings = 8;
  constexpr int kStepsPerDoubling = 4;
  for (int step = 0; step < kDoublings * kStepsPerDoubling; ++step) {
    const double side = least * std::exp2(static_cast<double>(step) / kStepsPerDoubling);
    for (std::uint32_t columns = 1; columns <= costs.shell.most_columns; columns *= 2) {
      Level& level = trial.level[index];
      level = make_level(stats.facts, r_max, side, columns, most_bits);
      const Members members = divide(stats, trial)[static_cast<std::size_t>(index)];
      const int passes =
          sort_passes(static_cast<int>(std::bit_width(level.ids - 1)), costs.digit_bits);
      const double cost =
          cost_within(level, members, costs.shell) + members.count * passes * costs.shell.per_pass;
      if (cost >= best_cost) continue;
      best = level;
      best_cost = cost;
    }
  }
  return best;
}

Levels levels_cut_at(const SceneStats& stats, const Cuts& cuts, const Costs& costs) {
  const int most_bits = kMaxKeyBits - static_cast<int>(std::bit_width(cuts.size()));
  Levels levels;
  for (std::size_t k = 0; k <= cuts.size(); ++k) {
    const float r_max = k < cuts.size() ? cuts[k] : stats.facts.r_max;
    Level level = cheapest_level(stats, r_max, most_bits, levels, costs);
    if (levels.count > 0) {
      const Level& below = levels.level[levels.count - 1];
      level.first_id = below.first_id + below.ids;
    }
    levels.level[levels.count++] = level;
  }
  return levels;
}

}  // namespace

double estimate_cost(const SceneStats& stats, const Levels& levels, const Costs& costs) {
  const std::vector<Members> members = divide(stats, levels);
  double cost = 0.0;
  for (int fine = 0; fine < levels.count; ++fine) {
    const Level& level = levels.level[fine];
    cost += cost_within(level, members[fine], costs.shell);
    for (int coarse = fine + 1; coarse < levels.count; ++coarse) {
      cost += costs.shell.finer_probe
                  ? cost_of_finer(levels.level[coarse], members[coarse], members[fine], costs.shell)
                  : cost_of_coarser(stats, members[coarse], level, members[fine], costs.shell);
    }
  }
  const int passes = sort_passes(key_bits_of(levels), costs.digit_bits);
  return cost + static_cast<double>(stats.facts.sphere_count) * passes * costs.shell.per_pass;
}

int key_bits_of(const Levels& levels) {
  if (levels.count == 0) return 0;
  const Level& last = levels.level[levels.count - 1];
  return static_cast<int>(std::bit_width(last.first_id + last.ids - 1));
}

Levels cheapest_levels(const SceneStats& stats, const Costs& costs) {
  Cuts cuts;
  Levels best = levels_cut_at(stats, cuts, costs);
  double best_cost = estimate_cost(stats, best, costs);
  for (bool better = true; better && best.count < kMaxLevels;) {
    better = false;
    Cuts best_cuts = cuts;
    for (std::size_t k = 0; k + 1 < stats.radii.size(); ++k) {
      const float cut = stats.radii[k].largest;
      if (std::ranges::find(cuts, cut) != cuts.end() || cut >= stats.facts.r_max) continue;
      Cuts trial = cuts;
      trial.insert(std::ranges::upper_bound(trial, cut), cut);
      const Levels levels = levels_cut_at(stats, trial, costs);
      const double cost = estimate_cost(stats, levels, costs);
      if (cost >= best_cost) continue;
      better = true;
      best = levels;
      best_cost = cost;
      best_cuts = trial;
    }
    cuts = best_cuts;
  }
  return best;
}

}  // namespace octocell
