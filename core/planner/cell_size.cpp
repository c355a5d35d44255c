// SPDX-License-Identifier: MIT
// How large should a cell be?  With small cells, a sphere meets many, and all are sorted. With
// large cells, many spheres share one, and all pairs are tested. Rule lowest_cell is correct for
// any size, so cost decides.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/digit_plan.hpp"
#include "core/planner/cell_counter.hpp"
#include "core/planner/planner.hpp"

namespace octocell {
namespace {

constexpr double kStep = 1.189207115002721;  // 2^(1/4)
constexpr int kMaxSteps = 160;

/// Returns how many cells a sphere of that radius is expected to meet, wherever it lies.
double ids_of_one(const Grid& grid, double radius) {
  double ids = 1.0;
  for (const std::uint32_t along_axis : grid.cell_count) {
    ids *= std::min(1.0 + 2.0 * radius / grid.cell_side, static_cast<double>(along_axis));
  }
  return ids;
}

double expected_ids(const SceneStats& stats, const Grid& grid) {
  double ids = 0.0;
  for (const RadiusClass& c : stats.radii) {
    ids += static_cast<double>(c.count) * ids_of_one(grid, c.mean_radius());
  }
  return ids;
}

/// Returns the number of cells, or, if far cells share ids, of ids.
double distinct_ids(const Grid& grid) {
  double cells = 1.0;
  for (const std::uint32_t along_axis : grid.cell_count) cells *= along_axis;
  return std::min(cells, std::ldexp(1.0, grid.key_bits));
}

/// Returns how many pairs of homes share a cell, scaled up from the sample. The sample shows
/// crowding that an average over the scene's box does not.
double home_pairs_by_sample(const SceneStats& stats, const Grid& grid) {
  CellCounter counter;
  std::uint64_t pairs = 0;
  for (const Sphere& s : stats.sample) {
    pairs += counter.count_before(cell_id(grid, cell_of(grid, s.x, s.y, s.z)));
  }
  const double scale =
      static_cast<double>(stats.facts.sphere_count) / static_cast<double>(stats.sample.size());
  return static_cast<double>(pairs) * scale * scale;
}

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

WorkEstimate estimate_work(const SceneStats& stats, const Grid& grid, const Costs& costs) {
  WorkEstimate work;
  if (stats.facts.sphere_count == 0) return work;
  const auto count = static_cast<double>(stats.facts.sphere_count);
  work.ids = std::max(expected_ids(stats, grid), count);
  const double spread = work.ids / count;
  const double uniform = work.ids * work.ids / 2.0 / distinct_ids(grid);
  work.candidates = std::max(uniform, home_pairs_by_sample(stats, grid) * spread * spread);
  const double passes = sort_passes(grid.key_bits, costs.digit_bits);
  work.cost_ns = work.ids * (costs.per_id + costs.per_id_and_pass * passes) +
                 work.candidates * costs.per_candidate +
                 ids_of_one(grid, static_cast<double>(stats.facts.r_max)) * costs.per_id_of_one;
  return work;
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

double estimate_cost(const SceneStats& stats, const Plan& plan, const Costs& costs) {
  if (plan.method == Method::half_shell) {
    return costs.per_grid + estimate_cost(stats, plan.levels, plan.key_bits, costs);
  }
  if (plan.method == Method::home_phantom) {
    const WorkEstimate work = estimate_work(stats, plan.grid, costs);
    const int more_passes = sort_passes(plan.key_bits, costs.digit_bits) -
                            sort_passes(plan.grid.key_bits, costs.digit_bits);
    return costs.per_grid + costs.per_run + work.cost_ns +
           work.ids * more_passes * costs.per_id_and_pass;
  }
  const auto count = static_cast<double>(stats.facts.sphere_count);
  return count * count / 2.0 * costs.per_pair + count * costs.per_row;
}

}  // namespace octocell
