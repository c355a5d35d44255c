// SPDX-License-Identifier: MIT
// Each sphere has one cell, a little wider than the largest sphere, so pairs lie in neighbouring
// cells. A row of cells is contiguous, so a sphere is compared with parts of five rows. Threads
// take rows in turn.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>
#include <vector>

#include "octocell_plugin.h"

namespace {

struct Grid {
  double corner[3];
  double side;
  uint32_t cells[3];
  [[nodiscard]] uint32_t row_of(uint32_t y, uint32_t z) const {
    return cells[0] * (y + cells[1] * z);
  }
};

/// About as many cells as spheres.
Grid choose_grid(const octocell_sphere* spheres, uint32_t n) {
  Grid grid = {{spheres[0].x, spheres[0].y, spheres[0].z}, 0, {1, 1, 1}};
  double high[3] = {grid.corner[0], grid.corner[1], grid.corner[2]};
  for (const octocell_sphere* s = spheres; s != spheres + n; ++s) {
    const double p[3] = {s->x, s->y, s->z};
    for (int axis = 0; axis < 3; ++axis) {
      grid.corner[axis] = std::min(grid.corner[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
    grid.side = std::max(grid.side, 2.0 * s->r);
  }
  grid.side *= 1 + 1e-9;  // more than rounding can move a sphere
  double widest = 0;
  for (int axis = 0; axis < 3; ++axis) widest = std::max(widest, high[axis] - grid.corner[axis]);
  grid.side = std::max(grid.side, widest / std::cbrt(4.0 * n));
  if (grid.side == 0) grid.side = 1;
  for (int axis = 0; axis < 3; ++axis)
    grid.cells[axis] = 1 + uint32_t((high[axis] - grid.corner[axis]) / grid.side);
  return grid;
}

uint32_t coordinate(const Grid& grid, double v, int axis) {
  return std::min(uint32_t((v - grid.corner[axis]) / grid.side), grid.cells[axis] - 1);
}

uint32_t cell_of(const Grid& grid, const octocell_sphere& s) {
  return coordinate(grid, s.x, 0) + grid.row_of(coordinate(grid, s.y, 1), coordinate(grid, s.z, 2));
}

/// Spheres in the order of their cells; cell c has places begins[c] to begins[c + 1] - 1.
struct Sorted {
  std::vector<uint32_t> begins;
  std::vector<uint32_t> ids;
  std::vector<octocell_sphere> spheres;
};

Sorted sort_by_cell(const Grid& grid, const octocell_sphere* spheres, uint32_t n) {
  std::vector<uint32_t> cells(n);
  Sorted sorted = {std::vector<uint32_t>(grid.row_of(0, grid.cells[2]) + 1),
                   std::vector<uint32_t>(n), std::vector<octocell_sphere>(n)};
  for (uint32_t i = 0; i < n; ++i) {
    cells[i] = cell_of(grid, spheres[i]);
    ++sorted.begins[cells[i] + 1];
  }
  std::partial_sum(sorted.begins.begin(), sorted.begins.end(), sorted.begins.begin());
  std::vector<uint32_t> next(sorted.begins.begin(), sorted.begins.end() - 1);
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t place = next[cells[i]]++;
    sorted.ids[place] = i;
    sorted.spheres[place] = spheres[i];
  }
  return sorted;
}

bool overlap(const octocell_sphere& a, const octocell_sphere& b) {
  const double x = double(a.x) - b.x;
  const double y = double(a.y) - b.y;
  const double z = double(a.z) - b.z;
  const double reach = double(a.r) + b.r;
  return x * x + y * y + z * z <= reach * reach;
}

using Pairs = std::vector<octocell_pair>;

/// Tests the sphere at `place` with those at `begin` to `end` - 1.
void test(const Sorted& sorted, uint32_t place, uint32_t begin, uint32_t end, Pairs& pairs) {
  const octocell_sphere s = sorted.spheres[place];
  for (uint32_t k = begin; k < end; ++k) {
    if (overlap(s, sorted.spheres[k])) pairs.push_back({sorted.ids[place], sorted.ids[k]});
  }
}

/// Half of the neighbours: the rest of the own row, then the rows behind it.
void test_row(const Grid& grid, const Sorted& sorted, uint32_t y, uint32_t z, Pairs& pairs) {
  constexpr int kBehind[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  const uint32_t last = grid.cells[0] - 1;
  for (uint32_t x = 0; x <= last; ++x) {
    const uint32_t left = x - (x > 0);
    const uint32_t right = x + (x < last);
    const uint32_t own = grid.row_of(y, z);
    for (uint32_t k = sorted.begins[own + x]; k < sorted.begins[own + x + 1]; ++k) {
      test(sorted, k, k + 1, sorted.begins[own + right + 1], pairs);
      for (const auto [dy, dz] : kBehind) {
        if (y + dy >= grid.cells[1] || z + dz >= grid.cells[2]) continue;
        const uint32_t row = grid.row_of(y + dy, z + dz);
        test(sorted, k, sorted.begins[row + left], sorted.begins[row + right + 1], pairs);
      }
    }
  }
}

}  // namespace

int find_pairs(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void* /*stream*/) {
  *count = 0;
  if (n == 0) return 0;
  const Grid grid = choose_grid(spheres, n);
  const Sorted sorted = sort_by_cell(grid, spheres, n);

  const uint32_t rows = grid.cells[1] * grid.cells[2];
  std::atomic<uint32_t> next_row = 0;
  std::vector<Pairs> found(std::max(1U, std::thread::hardware_concurrency()));
  {
    std::vector<std::jthread> threads;
    for (Pairs& own : found) {
      threads.emplace_back([&] {
        for (uint32_t row = next_row++; row < rows; row = next_row++)
          test_row(grid, sorted, row % grid.cells[1], row / grid.cells[1], own);
      });
    }
  }
  for (const Pairs& own : found) {
    const uint64_t room = capacity - std::min(capacity, *count);
    std::copy_n(own.begin(), std::min<uint64_t>(room, own.size()), pairs + *count);
    *count += own.size();
  }
  return 0;
}
