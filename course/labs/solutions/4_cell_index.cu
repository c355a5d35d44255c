// SPDX-License-Identifier: MIT
#include "../device_array.cuh"
#include "octocell_stage.h"

/// A thread looks at an entry. The thread of a cell's first entry lists the cell.
__global__ void list_cells(const uint32_t* ids, const uint32_t* objects, uint32_t n,
                           octocell_cell* cells, uint64_t capacity, unsigned long long* count) {
  const uint32_t begin = blockIdx.x * blockDim.x + threadIdx.x;
  if (begin >= n || (begin > 0 && ids[begin - 1] == ids[begin])) return;
  octocell_cell cell = {begin, 0, 0};
  for (uint32_t k = begin; k < n && ids[k] == ids[begin]; ++k) {
    const bool is_phantom = (objects[k] & OCTOCELL_PHANTOM) != 0;
    ++(is_phantom ? cell.phantoms : cell.homes);
  }
  if (cell.homes + cell.phantoms < 2) return;
  const uint64_t place = atomicAdd(count, 1ULL);
  if (place < capacity) cells[place] = cell;
}

int cell_index(const uint32_t* ids, const uint32_t* objects, uint32_t n, octocell_cell* cells,
               uint64_t capacity, uint64_t* count) {
  const DeviceArray<uint32_t> sorted_ids(ids, n);
  const DeviceArray<uint32_t> sorted_objects(objects, n);
  const DeviceArray<octocell_cell> listed(capacity);
  DeviceArray<unsigned long long> counted(1);
  counted.fill_with_zeros(1);
  list_cells<<<blocks_for(n), 128>>>(sorted_ids.data(), sorted_objects.data(), n, listed.data(),
                                     capacity, counted.data());
  check(cudaGetLastError());
  unsigned long long found = 0;
  counted.copy_to(&found, 1);
  *count = found;
  listed.copy_to(cells, found < capacity ? found : capacity);
  return 0;
}
