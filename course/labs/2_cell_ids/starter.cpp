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
    uint32_t home[3];
    for (int axis = 0; axis < 3; ++axis) home[axis] = cell_of(p[axis], *grid, axis);
    ids[i] = home[0] + grid->cells[0] * (home[1] + grid->cells[1] * home[2]);
    objects[i] = i;
    // Your part: the other cells that the sphere's box meets, from place *count on, and the four
    // control bits of all entries.
  }
  return 0;
}
