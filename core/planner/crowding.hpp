// SPDX-License-Identifier: MIT
// How close together the spheres of a level are, according to its sample.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/planner/scene_stats.hpp"

namespace octocell {

/// Octaves of radii [first, last) of SceneStats::radii.
using Octaves = std::pair<std::size_t, std::size_t>;

/// The spheres of a level.
struct Members {
  double count = 0.0;
  double radius_sum = 0.0;
  float r_max = 0.0F;
  std::vector<Sphere> sample;
  [[nodiscard]] double mean_radius() const { return count == 0.0 ? 0.0 : radius_sum / count; }
};

Members members_of(const SceneStats& stats, Octaves octaves);

/// Returns how many columns make a cell as long as it is wide, or as long as the scene if that is
/// shorter.
std::uint32_t columns_per_cell(const Grid& grid);

inline double rows_of_cells(const Grid& grid) {
  return static_cast<double>(grid.period(1)) * grid.period(2);
}

/// How close together the spheres of a level are.
struct Crowding {
  double in_cell;      // spheres in the cell around one of them
  double filled_rows;  // rows of cells that hold spheres
};
Crowding crowding_of(const Level& level, const Members& members);

/// Returns only Crowding::in_cell.
double neighbours_in_cell(const Level& level, const Members& members);

}  // namespace octocell
