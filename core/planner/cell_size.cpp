// SPDX-License-Identifier: MIT
// How large should a cell be?  With small cells, a sphere meets many, and all are sorted. With
// large cells, many spheres share one, and all pairs are tested. Rule lowest_cell is correct for
// any size, so cost decides.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/planner/cost_model.hpp"
#include "core/planner/planner.hpp"

namespace octocell {
namespace {

constexpr double kStep = 1.189207115002721;  // 2^(1/4)
constexpr int kMaxSteps = 160;

double largest_extent(const PlanFacts& facts) {
  double extent = 0.0;
  for (int a = 0; a < 3; ++a) {
    extent = std::max(extent, static_cast<double>(facts.highest[a]) - facts.lowest[a]);
  }
  return extent;
}

struct SideRange {
  double smallest;
  double largest;
};

SideRange sides_worth_trying(const SceneStats& stats) {
  const PlanFacts& facts = stats.facts;
  const double spacing = mean_spacing(facts);
  if (facts.r_max == 0.0F) {
    const double extent = largest_extent(facts);
    return {std::max(extent * 0x1p-24, 0x1p-149), std::max(spacing, 0x1p-149)};
  }
  double smallest = 2.0 * facts.r_min_nonzero;
  // Points among larger spheres may be crowded, however large the smallest of those is.
  if (facts.r_min == 0.0F) smallest = std::min(smallest, std::max(spacing * 0x1p-8, 0x1p-149));
  return {smallest, std::max(12.0 * facts.r_max, spacing)};
}

}  // namespace

double mean_spacing(const PlanFacts& facts) {
  double extent[3];
  for (int a = 0; a < 3; ++a) extent[a] = static_cast<double>(facts.highest[a]) - facts.lowest[a];
  std::sort(extent, extent + 3);
  const auto count = static_cast<double>(facts.sphere_count);
  const double volume_spacing = std::cbrt(extent[0] * extent[1] * extent[2] / count);
  const double area_spacing = std::sqrt(extent[1] * extent[2] / count);
  const double length_spacing = extent[2] / count;
  if (extent[0] >= volume_spacing && volume_spacing > 0.0) return volume_spacing;
  return extent[1] >= area_spacing && area_spacing > 0.0 ? area_spacing : length_spacing;
}

Grid cheapest_grid(const SceneStats& stats, const Costs& costs) {
  const SideRange range = sides_worth_trying(stats);
  const double widest = widest_box(stats.facts, stats.facts.r_max);
  const double step =
      std::max(kStep, std::pow(range.largest / range.smallest, 1.0 / (kMaxSteps - 1)));
  Grid best = make_grid(stats.facts, range.smallest, widest);
  double best_cost = estimate_work(stats, best, costs).cost_ns;
  for (double side = range.smallest * step; side <= range.largest * step; side *= step) {
    const Grid grid = make_grid(stats.facts, side, widest);
    const double cost = estimate_work(stats, grid, costs).cost_ns;
    if (cost >= best_cost) continue;
    best = grid;
    best_cost = cost;
  }
  return best;
}

}  // namespace octocell
