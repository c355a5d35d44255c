// SPDX-License-Identifier: MIT
// Which size classes does half_shell need, and how large are their cells?  Any cells at least a
// diameter wide are correct, so cost decides: one level for spheres of similar size, and one more
// if a few large spheres would make the cells of all others too large.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/digit_plan.hpp"
#include "core/planner/bulk.hpp"
#include "core/planner/crowding.hpp"
#include "core/planner/planner.hpp"

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

double cost_of(const Level& level, const Members& members, const Crowding& crowding,
               const Costs& costs) {
  const int key_bits = static_cast<int>(std::bit_width(level.ids - 1));
  return cost_within(level, members, crowding, costs.shell) +
         members.count * sort_passes(key_bits, costs.digit_bits) * costs.shell.per_pass;
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

double cost_across(const SceneStats& stats, const Level& coarser, const Members& coarse,
                   const Level& finer, const Members& fine, const ShellCosts& costs) {
  if (costs.finer_probe) return cost_of_finer(coarser, coarse, fine, costs);
  return cost_of_coarser(stats, coarse, finer, fine, costs);
}

struct Choice {
  Level level;
  double cost = HUGE_VAL;  // expected cost of the level's spheres among themselves
};

/// Makes an axis longer than a cell: upwards, or downwards, or both ways if float32 ends.
void thicken(PlanFacts& facts, int axis, double side) {
  float& lowest = facts.lowest[axis];
  float& highest = facts.highest[axis];
  const double second = static_cast<double>(lowest) + 1.5 * side;
  const double first = static_cast<double>(highest) - 1.5 * side;
  if (highest < kFloatMax && second < kFloatMax) {
    highest = std::max(static_cast<float>(second), std::nextafter(highest, kFloatMax));
  } else if (lowest > -kFloatMax && first > -kFloatMax) {
    lowest = std::min(static_cast<float>(first), std::nextafter(lowest, -kFloatMax));
  } else {
    lowest = -kFloatMax;
    highest = kFloatMax;
  }
}

/// Makes a flat scene thick enough for two layers of cells, if float32 has room for two. A larger
/// box may get larger cells than requested, so the grid that results decides.
PlanFacts with_two_layers(PlanFacts facts, float r_max, double side, int most_bits) {
  constexpr int kTrials = 4;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Grid grid = make_level(facts, r_max, side, 1, most_bits).grid;
    if (!has_one_layer(grid)) break;
    for (const int a : {1, 2}) {
      if (grid.cell_count[a] == 1) thicken(facts, a, grid.cell_side);
    }
  }
  return facts;
}

/// Returns the cheapest way to cut cells of that side into columns.
Choice cut_into_columns(const PlanFacts& facts, double side, int most_bits, const Members& members,
                        const Costs& costs) {
  Choice best;
  const Level whole_cells = make_level(facts, members.r_max, side, 1, most_bits);
  const Crowding crowding = crowding_of(whole_cells, members);
  for (std::uint32_t columns = 1; columns <= costs.shell.most_columns; columns *= 2) {
    const Level level = make_level(facts, members.r_max, side, columns, most_bits);
    const double cost = cost_of(level, members, crowding, costs);
    if (cost < best.cost) best = {level, cost};
  }
  return best;
}

constexpr int kPatience = 3;  // in doublings of the side: costs drop again where the sort saves a
                              // pass

/// Returns the level with the cheapest cell side: a diameter, or more if spheres are far apart.
Choice cheapest_level(const SceneStats& stats, Skips allowed, int most_bits, const Members& members,
                      const Costs& costs) {
  double side = 2.0 * static_cast<double>(members.r_max);
  if (side == 0.0) side = std::max(mean_spacing(stats.facts) / 2.0, 0x1p-149);
  Choice best;
  const int sides = costs.shell.sides_per_doubling;
  for (int worse = 0; worse < kPatience * sides; side *= std::exp2(1.0 / sides)) {
    const bool may_be_flat = allowed.has(Skip::layers);
    const PlanFacts facts =
        may_be_flat ? stats.facts : with_two_layers(stats.facts, members.r_max, side, most_bits);
    const Choice choice = cut_into_columns(facts, side, most_bits, members, costs);
    const bool is_too_large = !may_be_flat && has_one_layer(choice.level.grid);
    if (choice.cost >= best.cost || (is_too_large && best.cost < HUGE_VAL)) {
      ++worse;
      continue;
    }
    best = choice;
    worse = 0;
  }
  return best;
}

/// Tries ways to cut the octaves of the radii into levels.
class LevelSearch {
 public:
  LevelSearch(const SceneStats& stats, Skips allowed, const Costs& costs)
      : stats_(stats), allowed_(allowed), costs_(costs) {}

  /// Cuts where that saves most, as long as it saves anything.
  Levels run(std::size_t least_levels, std::size_t most_levels) {
    std::vector<Octaves> best = {{0, stats_.radii.size()}};
    double best_cost = cost(best);
    for (bool better = true; better && best.size() < most_levels;) {
      better = false;
      const std::vector<Octaves> so_far = best;
      if (best.size() < least_levels) best_cost = HUGE_VAL;
      for (std::size_t level = 0; level < so_far.size(); ++level) {
        for (std::size_t k = so_far[level].first + 1; k < so_far[level].second; ++k) {
          std::vector<Octaves> trial = so_far;
          trial[level].second = k;
          trial.insert(trial.begin() + static_cast<std::ptrdiff_t>(level) + 1,
                       {k, so_far[level].second});
          const double trial_cost = cost(trial);
          if (trial_cost >= best_cost) continue;
          better = true;
          best = trial;
          best_cost = trial_cost;
        }
      }
    }
    return levels(best);
  }

 private:
  /// Leaves room for six levels whose ids together stay below 2^kMaxKeyBits.
  static constexpr int kMostBits = kMaxKeyBits - 3;
  static_assert(kMaxLevels <= 1 << 3);

  struct Known {
    Members members;
    Choice choice;
  };
  const Known& known(Octaves octaves) {
    const auto [entry, is_new] = known_.try_emplace(octaves);
    if (is_new) {
      entry->second.members = members_of(stats_, octaves);
      entry->second.choice =
          cheapest_level(stats_, allowed_, kMostBits, entry->second.members, costs_);
    }
    return entry->second;
  }

  double cost(const std::vector<Octaves>& cuts) {
    double sum = 0.0;
    for (std::size_t fine = 0; fine < cuts.size(); ++fine) {
      const Known& finer = known(cuts[fine]);
      sum += finer.choice.cost;
      for (std::size_t coarse = fine + 1; coarse < cuts.size(); ++coarse) {
        const Known& coarser = known(cuts[coarse]);
        sum += cost_across(stats_, coarser.choice.level, coarser.members, finer.choice.level,
                           finer.members, costs_.shell);
      }
    }
    return sum;
  }

  Levels levels(const std::vector<Octaves>& cuts) {
    Levels levels;
    std::uint32_t first_id = 0;
    for (const Octaves& octaves : cuts) {
      Level& level = levels.level[levels.count++];
      level = known(octaves).choice.level;
      level.first_id = first_id;
      first_id += level.ids;
    }
    return levels;
  }

  const SceneStats& stats_;
  const Skips allowed_;
  const Costs& costs_;
  std::map<Octaves, Known> known_;
};

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

int key_bits_of(const Levels& levels) {
  if (levels.count == 0) return 0;
  const Level& last = levels.level[levels.count - 1];
  return static_cast<int>(std::bit_width(last.first_id + last.ids - 1));
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

Levels cheapest_levels(const SceneStats& stats, Skips allowed, const Costs& costs,
                       std::size_t least_levels) {
  const std::size_t most_levels = allowed.has(Skip::wide_cells) ? kMaxLevels : 1;
  return LevelSearch(stats, allowed, costs).run(least_levels, most_levels);
}

}  // namespace octocell
