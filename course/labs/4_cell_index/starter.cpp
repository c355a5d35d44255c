// SPDX-License-Identifier: MIT
#include "octocell_stage.h"

int cell_index(const uint32_t* ids, const uint32_t* objects, uint32_t n, octocell_cell* cells,
               uint64_t capacity, uint64_t* count) {
  *count = 0;
  for (uint32_t begin = 0, end = 0; begin < n; begin = end) {
    octocell_cell cell = {begin, 0, 0};
    // Your part: one more than the last entry of this cell; how many of its entries are homes, and
    // how many phantoms; leave out cells with fewer than two entries.
    end = begin + 1;
    cell.homes = 1;
    if (*count < capacity) cells[*count] = cell;
    ++*count;
  }
  return 0;
}
