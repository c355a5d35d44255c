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

PYTHON = """
import numpy as np

def find_pairs(spheres):
    s = spheres.astype(np.float64)
    found = [np.empty((0, 2), int)]
    for i in range(len(s)):
        d = s[i + 1 :] - s[i]
        near = (d[:, :3] ** 2).sum(axis=1) <= (s[i + 1 :, 3] + s[i, 3]) ** 2
        j = np.flatnonzero(near) + i + 1
        found.append(np.column_stack([np.full_like(j, i), j]))
    return np.concatenate(found)
"""


def changed(old: str, new: str) -> str:
    assert BRUTE_FORCE.count(old) == 1
    return BRUTE_FORCE.replace(old, new)


def at_1000(statement: str) -> str:
    """Brute force that does something else in a scene of 1000 spheres."""
    return changed("  uint64_t k = 0;", f"  uint64_t k = 0;\n  if (n == 1000) {{ {statement} }}")
