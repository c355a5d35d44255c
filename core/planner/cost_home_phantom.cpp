// SPDX-License-Identifier: MIT
// What a plan is expected to cost; here home_phantom: ids and candidates, by the box and by the
// sample.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/digit_plan.hpp"
#include "core/planner/cell_counter.hpp"
#include "core/planner/cost_model.hpp"

namespace octocell {
namespace {

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

}  // namespace

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

double estimate_cost(const SceneStats& stats, const Plan& plan, const Costs& costs) {
  if (plan.method == Method::half_shell || plan.method == Method::tiles) {
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
