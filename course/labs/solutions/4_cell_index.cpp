// SPDX-License-Identifier: MIT
#include "octocell_stage.h"

int cell_index(const uint32_t* ids, const uint32_t* objects, uint32_t n, octocell_cell* cells,
               uint64_t capacity, uint64_t* count) {
  *count = 0;
  for (uint32_t begin = 0, end = 0; begin < n; begin = end) {
    octocell_cell cell = {begin, 0, 0};
    for (end = begin; end < n && ids[end] == ids[begin]; ++end) {
      const bool is_phantom = (objects[end] & OCTOCELL_PHANTOM) != 0;
      ++(is_phantom ? cell.phantoms : cell.homes);
    }
    if (end - begin < 2) continue;
    if (*count < capacity) cells[*count] = cell;
    ++*count;
  }
  return 0;
}
