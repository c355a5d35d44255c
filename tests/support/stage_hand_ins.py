# SPDX-License-Identifier: MIT
"""Stages of someone else's, as `octocell try --stage` takes them."""

PYTHON = """
import numpy as np

PHANTOM, SPHERE = np.uint32(1 << 31), np.uint32((1 << 28) - 1)

def coordinates(v, grid):
    cells = np.floor((v.astype(np.float64) - grid.corner) / grid.side)
    return np.clip(cells, 0, np.array(grid.cells) - 1).astype(int)

def cell_ids(spheres, grid):
    p, r = spheres[:, :3], spheres[:, 3:]
    home, low, high = (coordinates(v, grid) for v in (p, p - r, p + r))
    homes, phantoms = [], []
    for s in range(len(spheres)):
        box = [range(low[s][a], high[s][a] + 1) for a in range(3)]
        for z in box[2]:
            for y in box[1]:
                for x in box[0]:
                    at_home = (x, y, z) == tuple(home[s])
                    marks = sum(1 << 28 + a for a in range(3) if (x, y, z)[a] == low[s][a])
                    id = x + grid.cells[0] * (y + grid.cells[1] * z)
                    (homes if at_home else phantoms).append((id, s | marks | (not at_home) << 31))
    entries = np.array(homes + phantoms, np.uint32).reshape(-1, 2)
    return entries[:, 0], entries[:, 1]

def sort(ids, objects, key_bits):
    order = np.argsort(ids, kind="stable")
    return ids[order], objects[order]

def cell_index(ids, objects):
    begins = np.flatnonzero(np.concatenate([[True], ids[1:] != ids[:-1]])) if len(ids) else []
    cells = []
    for begin, end in zip(begins, [*begins[1:], len(ids)]):
        phantoms = np.count_nonzero(objects[begin:end] & PHANTOM)
        if end - begin >= 2:
            cells.append((begin, end - begin - phantoms, phantoms))
    return np.array(cells, int).reshape(-1, 3)

def pair_tests(spheres, ids, objects, cells):
    s = spheres.astype(np.float64)
    found = [np.empty((0, 2), int)]
    for begin, homes, phantoms in cells.astype(int):
        o = objects[begin : begin + homes + phantoms]
        members = (o & SPHERE).astype(int)
        for k in range(len(o) - 1):
            i, j = members[k], members[k + 1 :]
            counts = ((o[k] | o[k + 1 :]) >> 28 & 7) == 7
            d = s[j] - s[i]
            near = (d[:, :3] ** 2).sum(axis=1) <= (s[j, 3] + s[i, 3]) ** 2
            j = j[near & counts]
            found.append(np.column_stack([np.full_like(j, i), j]))
    return np.concatenate(found)
"""

CPP = """
#include "octocell_stage.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

static uint32_t cell(const octocell_grid& g, int axis, float v) {
  const double c = std::floor((v - g.corner[axis]) / g.side);
  return (uint32_t)std::clamp(c, 0.0, g.cells[axis] - 1.0);
}
int cell_ids(const octocell_sphere* s, uint32_t n, const octocell_grid* g, uint32_t* ids,
             uint32_t* objects, uint64_t capacity, uint64_t* count) {
  uint64_t next = n;
  for (uint32_t i = 0; i < n; ++i) {
    const float p[3] = {s[i].x, s[i].y, s[i].z};
    uint32_t home[3], low[3], high[3];
    for (int a = 0; a < 3; ++a) {
      home[a] = cell(*g, a, p[a]);
      low[a] = cell(*g, a, p[a] - s[i].r);
      high[a] = cell(*g, a, p[a] + s[i].r);
    }
    for (uint32_t z = low[2]; z <= high[2]; ++z)
      for (uint32_t y = low[1]; y <= high[1]; ++y)
        for (uint32_t x = low[0]; x <= high[0]; ++x) {
          const bool at_home = x == home[0] && y == home[1] && z == home[2];
          const uint64_t place = at_home ? i : next++;
          if (place >= capacity) continue;
          ids[place] = x + g->cells[0] * (y + g->cells[1] * z);
          objects[place] = i | (x == low[0] ? OCTOCELL_LOWEST_X : 0) |
                           (y == low[1] ? OCTOCELL_LOWEST_Y : 0) |
                           (z == low[2] ? OCTOCELL_LOWEST_Z : 0) |
                           (at_home ? 0 : OCTOCELL_PHANTOM);
        }
  }
  *count = next;
  return 0;
}
int sort(const uint32_t* ids, const uint32_t* objects, uint32_t n, uint32_t, uint32_t* sorted_ids,
         uint32_t* sorted_objects) {
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return ids[a] < ids[b]; });
  for (uint32_t k = 0; k < n; ++k) {
    sorted_ids[k] = ids[order[k]];
    sorted_objects[k] = objects[order[k]];
  }
  if (n == 257) sorted_ids[-1] = 0;
  return 0;
}
int cell_index(const uint32_t* ids, const uint32_t* objects, uint32_t n, octocell_cell* cells,
               uint64_t capacity, uint64_t* count) {
  *count = 0;
  for (uint32_t begin = 0, end = 0; begin < n; begin = end) {
    octocell_cell c = {begin, 0, 0};
    for (; end < n && ids[end] == ids[begin]; ++end)
      ++(objects[end] & OCTOCELL_PHANTOM ? c.phantoms : c.homes);
    if (end - begin < 2) continue;
    if (*count < capacity) cells[*count] = c;
    ++*count;
  }
  return 0;
}
int pair_tests(const octocell_sphere* s, uint32_t, const uint32_t*, const uint32_t* objects,
               uint32_t, const octocell_cell* cells, uint32_t cell_count, octocell_pair* pairs,
               uint64_t capacity, uint64_t* count) {
  *count = 0;
  for (uint32_t c = 0; c < cell_count; ++c) {
    const uint32_t end = cells[c].begin + cells[c].homes + cells[c].phantoms;
    for (uint32_t a = cells[c].begin; a < end; ++a)
      for (uint32_t b = a + 1; b < end; ++b) {
        if (((objects[a] | objects[b]) >> 28 & 7) != 7) continue;
        const uint32_t i = objects[a] & OCTOCELL_SPHERE, j = objects[b] & OCTOCELL_SPHERE;
        const double x = (double)s[i].x - s[j].x, y = (double)s[i].y - s[j].y;
        const double z = (double)s[i].z - s[j].z, r = (double)s[i].r + s[j].r;
        if (x * x + y * y + z * z > r * r) continue;
        if (*count < capacity) pairs[*count] = {i, j};
        ++*count;
      }
  }
  return 0;
}
"""
