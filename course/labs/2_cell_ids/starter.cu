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
  uint32_t home[3];
  for (int axis = 0; axis < 3; ++axis) home[axis] = cell_of(p[axis], grid, axis);
  ids[i] = home[0] + grid.cells[0] * (home[1] + grid.cells[1] * home[2]);
  objects[i] = i;
  // Your part: the other cells that the sphere's box meets, each at a place that atomicAdd(count,
  // 1) gives, and the four control bits of all entries.
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
