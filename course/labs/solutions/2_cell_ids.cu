// SPDX-License-Identifier: MIT
#include "../device_array.cuh"
#include "octocell_stage.h"

__device__ uint32_t cell_of(float v, const octocell_grid& grid, int axis) {
  const double cell = floor((v - grid.corner[axis]) / grid.side);
  return uint32_t(fmin(fmax(cell, 0.0), grid.cells[axis] - 1.0));
}

/// A thread lists the cells of a sphere. Threads reserve places for phantoms with atomicAdd.
__global__ void list_cells(const octocell_sphere* spheres, uint32_t n, octocell_grid grid,
                           uint32_t* ids, uint32_t* objects, uint64_t capacity,
                           unsigned long long* count) {
  const uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= n) return;
  const float p[3] = {spheres[i].x, spheres[i].y, spheres[i].z};
  uint32_t home[3], low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    home[axis] = cell_of(p[axis], grid, axis);
    low[axis] = cell_of(p[axis] - spheres[i].r, grid, axis);
    high[axis] = cell_of(p[axis] + spheres[i].r, grid, axis);
  }
  for (uint32_t z = low[2]; z <= high[2]; ++z) {
    for (uint32_t y = low[1]; y <= high[1]; ++y) {
      for (uint32_t x = low[0]; x <= high[0]; ++x) {
        const bool is_home = x == home[0] && y == home[1] && z == home[2];
        const uint64_t place = is_home ? i : atomicAdd(count, 1ULL);
        if (place >= capacity) continue;
        ids[place] = x + grid.cells[0] * (y + grid.cells[1] * z);
        objects[place] =
            i | (is_home ? 0 : OCTOCELL_PHANTOM) | (x == low[0] ? OCTOCELL_LOWEST_X : 0) |
            (y == low[1] ? OCTOCELL_LOWEST_Y : 0) | (z == low[2] ? OCTOCELL_LOWEST_Z : 0);
      }
    }
  }
}

int cell_ids(const octocell_sphere* spheres, uint32_t n, const octocell_grid* grid, uint32_t* ids,
             uint32_t* objects, uint64_t capacity, uint64_t* count) {
  const DeviceArray<octocell_sphere> s(spheres, n);
  const DeviceArray<uint32_t> listed_ids(capacity);
  const DeviceArray<uint32_t> listed_objects(capacity);
  const unsigned long long homes = n;
  const DeviceArray<unsigned long long> counted(&homes, 1);
  list_cells<<<blocks_for(n), 128>>>(s.data(), n, *grid, listed_ids.data(), listed_objects.data(),
                                     capacity, counted.data());
  check(cudaGetLastError());
  unsigned long long entries = 0;
  counted.copy_to(&entries, 1);
  *count = entries;
  const uint64_t fit = entries < capacity ? entries : capacity;
  listed_ids.copy_to(ids, fit);
  listed_objects.copy_to(objects, fit);
  return 0;
}
