// SPDX-License-Identifier: MIT
#include "octocell_plugin.h"

int find_pairs(const octocell_sphere* s, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void* /*stream*/) {
  *count = 0;
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = i + 1; j < n; ++j) {
      const double x = double(s[i].x) - s[j].x;
      const double y = double(s[i].y) - s[j].y;
      const double z = double(s[i].z) - s[j].z;
      const double r = double(s[i].r) + s[j].r;
      if (x * x + y * y + z * z > r * r) continue;
      if (*count < capacity) pairs[*count] = {i, j};
      ++*count;
    }
  }
  return 0;
}
