// SPDX-License-Identifier: MIT
#include "../device_array.cuh"
#include "octocell_stage.h"

__device__ bool overlap(const octocell_sphere& a, const octocell_sphere& b) {
  const double x = double(a.x) - b.x;
  const double y = double(a.y) - b.y;
  const double z = double(a.z) - b.z;
  const double reach = double(a.r) + b.r;
  return x * x + y * y + z * z <= reach * reach;
}

/// Your part: is this, of the cells that both spheres share, the one in which their pair counts?
__device__ bool counts_here(uint32_t /*a*/, uint32_t /*b*/) { return true; }

/// A block takes a cell; its threads take the first sphere of each pair in turn.
__global__ void test_cells(const octocell_sphere* spheres, const uint32_t* objects,
                           const octocell_cell* cells, octocell_pair* pairs, uint64_t capacity,
                           unsigned long long* count) {
  const octocell_cell cell = cells[blockIdx.x];
  const uint32_t end = cell.begin + cell.homes + cell.phantoms;
  for (uint32_t a = cell.begin + threadIdx.x; a < end; a += blockDim.x) {
    for (uint32_t b = a + 1; b < end; ++b) {
      if (!counts_here(objects[a], objects[b])) continue;
      const uint32_t i = objects[a] & OCTOCELL_SPHERE;
      const uint32_t j = objects[b] & OCTOCELL_SPHERE;
      if (!overlap(spheres[i], spheres[j])) continue;
      const uint64_t place = atomicAdd(count, 1ULL);
      if (place < capacity) pairs[place] = {i, j};
    }
  }
}

int pair_tests(const octocell_sphere* spheres, uint32_t n, const uint32_t*, const uint32_t* objects,
               uint32_t entries, const octocell_cell* cells, uint32_t cell_count,
               octocell_pair* pairs, uint64_t capacity, uint64_t* count) {
  *count = 0;
  if (cell_count == 0) return 0;
  const DeviceArray<octocell_sphere> s(spheres, n);
  const DeviceArray<uint32_t> o(objects, entries);
  const DeviceArray<octocell_cell> c(cells, cell_count);
  const DeviceArray<octocell_pair> found(capacity);
  DeviceArray<unsigned long long> counted(1);
  counted.fill_with_zeros(1);
  test_cells<<<cell_count, 32>>>(s.data(), o.data(), c.data(), found.data(), capacity,
                                 counted.data());
  check(cudaGetLastError());
  unsigned long long pairs_found = 0;
  counted.copy_to(&pairs_found, 1);
  *count = pairs_found;
  found.copy_to(pairs, pairs_found < capacity ? pairs_found : capacity);
  return 0;
}
