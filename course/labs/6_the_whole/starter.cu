// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "../2_cell_ids/starter.cu"
#include "../3_sort/starter.cu"
#include "../4_cell_index/starter.cu"
#include "../5_pair_tests/starter.cu"
#include "octocell_plugin.h"

namespace {

/// Your part, 1: a better side. It must leave at most 1000 cells on an axis, so that ids fit into
/// 32 bits.
octocell_grid choose_grid(const octocell_sphere* spheres, uint32_t n) {
  std::array<float, 3> low = {spheres[0].x, spheres[0].y, spheres[0].z};
  std::array<float, 3> high = low;
  float largest = 0;
  for (const octocell_sphere* s = spheres; s != spheres + n; ++s) {
    const std::array<float, 3> p = {s->x, s->y, s->z};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
    largest = std::max(largest, s->r);
  }
  octocell_grid grid = {{low[0], low[1], low[2]}, 0.5 * largest, {1, 1, 1}};
  for (int axis = 0; axis < 3; ++axis)
    grid.side = std::max(grid.side, (double(high[axis]) - low[axis]) / 1000);
  if (grid.side == 0) grid.side = 1;  // all are points in one place
  for (int axis = 0; axis < 3; ++axis)
    grid.cells[axis] = 1 + uint32_t((high[axis] - grid.corner[axis]) / grid.side);
  return grid;
}

/// Cell ids are below 2^key_bits.
uint32_t key_bits_of(const octocell_grid& grid) {
  const uint64_t cells = uint64_t(grid.cells[0]) * grid.cells[1] * grid.cells[2];
  return uint32_t(std::bit_width(cells - 1));
}

}  // namespace

int find_pairs(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void* /*stream*/) {
  *count = 0;
  if (n == 0) return 0;
  const octocell_grid grid = choose_grid(spheres, n);

  uint64_t entries = 8 * uint64_t(n);
  std::vector<uint32_t> ids(entries);
  std::vector<uint32_t> objects(entries);
  if (cell_ids(spheres, n, &grid, ids.data(), objects.data(), ids.size(), &entries)) return 1;
  // Your part, 2: what if there are more entries than room? Here, phantoms are dropped.
  if (entries > ids.size()) entries = n;

  std::vector<uint32_t> sorted_ids(entries);
  std::vector<uint32_t> sorted_objects(entries);
  if (sort(ids.data(), objects.data(), entries, key_bits_of(grid), sorted_ids.data(),
           sorted_objects.data())) {
    return 1;
  }

  std::vector<octocell_cell> cells(entries / 2);  // each has at least two entries
  uint64_t cell_count = 0;
  if (cell_index(sorted_ids.data(), sorted_objects.data(), entries, cells.data(), cells.size(),
                 &cell_count)) {
    return 1;
  }
  return pair_tests(spheres, n, sorted_ids.data(), sorted_objects.data(), entries, cells.data(),
                    cell_count, pairs, capacity, count);
}
