// SPDX-License-Identifier: MIT
// How close the spheres of a level would be to each other, as its sample says.
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

/// How many make a cell as long as it is wide, or as long as the scene, where that is shorter.
std::uint32_t columns_per_cell(const Grid& grid);

inline double rows_of_cells(const Grid& grid) {
  return static_cast<double>(grid.period(1)) * grid.period(2);
}

/// How close its spheres are to each other.
struct Crowding {
  double in_cell;      // spheres in a cell around one of them
  double filled_rows;  // of rows of cells
};
Crowding crowding_of(const Level& level, const Members& members);

/// The first of the two alone.
double neighbours_in_cell(const Level& level, const Members& members);

}  // namespace octocell
