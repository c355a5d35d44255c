// SPDX-License-Identifier: MIT
#include "octocell_stage.h"

namespace {

bool overlap(const octocell_sphere& a, const octocell_sphere& b) {
  const double x = double(a.x) - b.x;
  const double y = double(a.y) - b.y;
  const double z = double(a.z) - b.z;
  const double reach = double(a.r) + b.r;
  return x * x + y * y + z * z <= reach * reach;
}

/// Of the cells that two spheres share, one is the lowest on each axis. The pair counts only there.
bool counts_here(uint32_t a, uint32_t b) {
  constexpr uint32_t kLowest = OCTOCELL_LOWEST_X | OCTOCELL_LOWEST_Y | OCTOCELL_LOWEST_Z;
  return ((a | b) & kLowest) == kLowest;
}

}  // namespace

int pair_tests(const octocell_sphere* spheres, uint32_t, const uint32_t*, const uint32_t* objects,
               uint32_t, const octocell_cell* cells, uint32_t cell_count, octocell_pair* pairs,
               uint64_t capacity, uint64_t* count) {
  *count = 0;
  for (const octocell_cell* cell = cells; cell != cells + cell_count; ++cell) {
    const uint32_t end = cell->begin + cell->homes + cell->phantoms;
    for (uint32_t a = cell->begin; a < end; ++a) {
      for (uint32_t b = a + 1; b < end; ++b) {
        if (!counts_here(objects[a], objects[b])) continue;
        const uint32_t i = objects[a] & OCTOCELL_SPHERE;
        const uint32_t j = objects[b] & OCTOCELL_SPHERE;
        if (!overlap(spheres[i], spheres[j])) continue;
        if (*count < capacity) pairs[*count] = {i, j};
        ++*count;
      }
    }
  }
  return 0;
}
