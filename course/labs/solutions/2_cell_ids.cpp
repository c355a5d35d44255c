// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "octocell_stage.h"

namespace {

uint32_t cell_of(float v, const octocell_grid& grid, int axis) {
  const double cell = std::floor((v - grid.corner[axis]) / grid.side);
  return uint32_t(std::clamp(cell, 0.0, grid.cells[axis] - 1.0));
}

}  // namespace

int cell_ids(const octocell_sphere* spheres, uint32_t n, const octocell_grid* grid, uint32_t* ids,
             uint32_t* objects, uint64_t capacity, uint64_t* count) {
  *count = n;
  for (uint32_t i = 0; i < n; ++i) {
    const float p[3] = {spheres[i].x, spheres[i].y, spheres[i].z};
    uint32_t home[3], low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      home[axis] = cell_of(p[axis], *grid, axis);
      low[axis] = cell_of(p[axis] - spheres[i].r, *grid, axis);
      high[axis] = cell_of(p[axis] + spheres[i].r, *grid, axis);
    }
    for (uint32_t z = low[2]; z <= high[2]; ++z) {
      for (uint32_t y = low[1]; y <= high[1]; ++y) {
        for (uint32_t x = low[0]; x <= high[0]; ++x) {
          const bool is_home = x == home[0] && y == home[1] && z == home[2];
          const uint64_t place = is_home ? i : (*count)++;
          if (place >= capacity) continue;
          ids[place] = x + grid->cells[0] * (y + grid->cells[1] * z);
          objects[place] =
              i | (is_home ? 0 : OCTOCELL_PHANTOM) | (x == low[0] ? OCTOCELL_LOWEST_X : 0) |
              (y == low[1] ? OCTOCELL_LOWEST_Y : 0) | (z == low[2] ? OCTOCELL_LOWEST_Z : 0);
        }
      }
    }
  }
  return 0;
}
