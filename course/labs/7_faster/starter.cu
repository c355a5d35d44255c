// SPDX-License-Identifier: MIT
// Each sphere has one cell, a little wider than the largest sphere, so pairs lie in neighbouring
// cells. Spheres are sorted by cell (by CUB's radix sort), and stay on the GPU until the pairs are
// found. A row of cells is contiguous, so a thread compares its sphere with parts of five rows.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cub/device/device_radix_sort.cuh>

#include "../device_array.cuh"
#include "octocell_plugin.h"

struct Grid {
  double corner[3];
  double side;
  uint32_t cells[3];
  __host__ __device__ uint32_t row_of(uint32_t y, uint32_t z) const {
    return cells[0] * (y + cells[1] * z);
  }
};

/// About as many cells as spheres.
Grid choose_grid(const octocell_sphere* spheres, uint32_t n) {
  Grid grid = {{spheres[0].x, spheres[0].y, spheres[0].z}, 0, {1, 1, 1}};
  double high[3] = {grid.corner[0], grid.corner[1], grid.corner[2]};
  for (const octocell_sphere* s = spheres; s != spheres + n; ++s) {
    const double p[3] = {s->x, s->y, s->z};
    for (int axis = 0; axis < 3; ++axis) {
      grid.corner[axis] = std::min(grid.corner[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
    grid.side = std::max(grid.side, 2.0 * s->r);
  }
  grid.side *= 1 + 1e-9;  // more than rounding can move a sphere
  double widest = 0;
  for (int axis = 0; axis < 3; ++axis) widest = std::max(widest, high[axis] - grid.corner[axis]);
  grid.side = std::max(grid.side, widest / std::cbrt(4.0 * n));
  if (grid.side == 0) grid.side = 1;
  for (int axis = 0; axis < 3; ++axis)
    grid.cells[axis] = 1 + uint32_t((high[axis] - grid.corner[axis]) / grid.side);
  return grid;
}

__device__ uint32_t coordinate(const Grid& grid, double v, int axis) {
  return min(uint32_t((v - grid.corner[axis]) / grid.side), grid.cells[axis] - 1);
}

/// Your part: float32 is faster, and all numbers are float32. Is that enough?
__device__ bool overlap(const octocell_sphere& a, const octocell_sphere& b) {
  const float x = a.x - b.x;
  const float y = a.y - b.y;
  const float z = a.z - b.z;
  const float reach = a.r + b.r;
  return x * x + y * y + z * z <= reach * reach;
}

__global__ void locate(const octocell_sphere* spheres, uint32_t n, Grid grid, uint32_t* cells,
                       uint32_t* ids) {
  const uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= n) return;
  cells[i] = coordinate(grid, spheres[i].x, 0) +
             grid.row_of(coordinate(grid, spheres[i].y, 1), coordinate(grid, spheres[i].z, 2));
  ids[i] = i;
}

/// Gathers the spheres in the order of their cells. begins[c] is the first place whose cell is c or
/// later: each thread writes those of the cells between its sphere's and the one before.
__global__ void gather(const octocell_sphere* from, const uint32_t* cells, const uint32_t* ids,
                       uint32_t n, uint32_t all_cells, octocell_sphere* to, uint32_t* begins) {
  const uint32_t k = blockIdx.x * blockDim.x + threadIdx.x;
  if (k > n) return;
  if (k < n) to[k] = from[ids[k]];
  const uint32_t last = k < n ? cells[k] : all_cells;
  for (uint32_t c = k == 0 ? 0 : cells[k - 1] + 1; c <= last; ++c) begins[c] = k;
}

struct Pairs {
  octocell_pair* pairs;
  uint64_t capacity;
  unsigned long long* count;
};

__device__ void test(const octocell_sphere* spheres, const uint32_t* ids, uint32_t place,
                     uint32_t begin, uint32_t end, Pairs to) {
  const octocell_sphere s = spheres[place];
  for (uint32_t k = begin; k < end; ++k) {
    if (!overlap(s, spheres[k])) continue;
    const uint64_t next = atomicAdd(to.count, 1ULL);
    if (next < to.capacity) to.pairs[next] = {ids[place], ids[k]};
  }
}

/// Half of the neighbours: the rest of the own row, then the rows behind it.
__global__ void test_all(const octocell_sphere* spheres, const uint32_t* cells, const uint32_t* ids,
                         uint32_t n, const uint32_t* begins, Grid grid, Pairs to) {
  const uint32_t k = blockIdx.x * blockDim.x + threadIdx.x;
  if (k >= n) return;
  const uint32_t x = cells[k] % grid.cells[0];
  const uint32_t y = cells[k] / grid.cells[0] % grid.cells[1];
  const uint32_t z = cells[k] / grid.cells[0] / grid.cells[1];
  const uint32_t left = x - (x > 0);
  const uint32_t right = x + (x + 1 < grid.cells[0]);
  test(spheres, ids, k, k + 1, begins[grid.row_of(y, z) + right + 1], to);
  constexpr int kBehind[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  for (int r = 0; r < 4; ++r) {
    const uint32_t row_y = y + kBehind[r][0];
    const uint32_t row_z = z + kBehind[r][1];
    if (row_y >= grid.cells[1] || row_z >= grid.cells[2]) continue;
    const uint32_t row = grid.row_of(row_y, row_z);
    test(spheres, ids, k, begins[row + left], begins[row + right + 1], to);
  }
}

int find_pairs(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void* /*stream*/) {
  *count = 0;
  if (n == 0) return 0;
  const Grid grid = choose_grid(spheres, n);
  const uint32_t all_cells = grid.row_of(0, grid.cells[2]);
  const DeviceArray<octocell_sphere> unsorted(spheres, n);
  const DeviceArray<octocell_sphere> sorted(n);
  const DeviceArray<uint32_t> cells(n);
  const DeviceArray<uint32_t> ids(n);
  const DeviceArray<uint32_t> sorted_cells(n);
  const DeviceArray<uint32_t> sorted_ids(n);
  const DeviceArray<uint32_t> begins(all_cells + 1);
  locate<<<blocks_for(n), 128>>>(unsorted.data(), n, grid, cells.data(), ids.data());

  std::size_t bytes = 0;  // CUB is called twice: first it says how much memory it needs
  const auto sort = [&](void* memory) {
    check(cub::DeviceRadixSort::SortPairs(memory, bytes, cells.data(), sorted_cells.data(),
                                          ids.data(), sorted_ids.data(), n));
  };
  sort(nullptr);
  const DeviceArray<char> memory(bytes);
  sort(memory.data());
  gather<<<blocks_for(n + 1ULL), 128>>>(unsorted.data(), sorted_cells.data(), sorted_ids.data(), n,
                                        all_cells, sorted.data(), begins.data());

  const DeviceArray<octocell_pair> found(capacity);
  DeviceArray<unsigned long long> counted(1);
  counted.fill_with_zeros(1);
  test_all<<<blocks_for(n), 128>>>(sorted.data(), sorted_cells.data(), sorted_ids.data(), n,
                                   begins.data(), grid, {found.data(), capacity, counted.data()});
  check(cudaGetLastError());
  unsigned long long pairs_found = 0;
  counted.copy_to(&pairs_found, 1);
  *count = pairs_found;
  found.copy_to(pairs, std::min<uint64_t>(capacity, pairs_found));
  return 0;
}
