# SPDX-License-Identifier: MIT
"""Broad phases of someone else's, as `octocell try` and `--plugin` take them."""

BRUTE_FORCE = """
#include "octocell_plugin.h"
static bool overlap(const octocell_sphere& a, const octocell_sphere& b) {
  const double x = (double)a.x - b.x, y = (double)a.y - b.y, z = (double)a.z - b.z;
  const double r = (double)a.r + b.r;
  return x * x + y * y + z * z <= r * r;
}
int find_pairs(const octocell_sphere* s, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void*) {
  uint64_t k = 0;
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = i + 1; j < n; ++j)
      if (overlap(s[i], s[j])) {
        if (k < capacity) pairs[k] = {i, j};
        ++k;
      }
  *count = k;
  return 0;
}
"""
