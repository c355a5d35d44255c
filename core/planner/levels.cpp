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

#include "core/planner/bulk.hpp"
#include "core/planner/cost_half_shell.hpp"
#include "core/planner/crowding.hpp"
#include "core/planner/planner.hpp"

namespace octocell {
namespace {

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

}  // namespace

int key_bits_of(const Levels& levels) {
  if (levels.count == 0) return 0;
  const Level& last = levels.level[levels.count - 1];
  return static_cast<int>(std::bit_width(last.first_id + last.ids - 1));
}

Levels cheapest_levels(const SceneStats& stats, Skips allowed, const Costs& costs,
                       std::size_t least_levels) {
  const std::size_t most_levels = allowed.has(Skip::wide_cells) ? kMaxLevels : 1;
  return LevelSearch(stats, allowed, costs).run(least_levels, most_levels);
}

}  // namespace octocell
