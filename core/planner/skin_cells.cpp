// SPDX-License-Identifier: MIT
#include "core/planner/planner.hpp"

namespace octocell {
namespace {

double mean_radius(const SceneStats& stats) {
  double sum = 0.0;
  for (const RadiusClass& c : stats.radii) sum += c.radius_sum;
  return sum / static_cast<double>(stats.facts.sphere_count);
}

SceneStats grown(SceneStats stats, float growth) {
  stats.facts.r_max = grown_radius(stats.facts.r_max, growth);
  stats.facts.r_min_nonzero = grown_radius(stats.facts.r_min_nonzero, growth);
  for (RadiusClass& c : stats.radii) {
    c.radius_sum += static_cast<double>(growth) * static_cast<double>(c.count);
    c.largest = grown_radius(c.largest, growth);
  }
  for (Sphere& s : stats.sample) s.r = grown_radius(s.r, growth);
  return stats;
}

}  // namespace

SkinCells skin_cells(const SceneStats& stats, Skips allowed, const Costs& costs) {
  SkinCells cells;
  if (!allowed.has(Skip::skin) || stats.facts.sphere_count == 0) return cells;
  const auto growth =
      static_cast<float>(mean_radius(stats) * static_cast<double>(most_skin(stats.static_share)));
  const bool in_range = growth >= kFastRadiusMin && stats.facts.r_max <= kFastRadiusMax;
  if (!in_range) return cells;
  cells.growth = growth;
  cells.static_share = stats.static_share;
  cells.levels = cheapest_levels(grown(stats, growth), allowed, costs);
  cells.key_bits = key_bits_of(cells.levels);
  return cells;
}

}  // namespace octocell
