// SPDX-License-Identifier: MIT
// Step 8: spheres compared as real numbers; the answer is exact.
//
// wins back  pairs that just touch, and loses those that just do not: float32 rounds both sides
// why        core/overlap.hpp decides in float64 with an error bound, else in integers
// cost       a few more operations a pair; octocell itself asks float32 first, with a bound
//
//   g++ -std=c++20 -O2 -ffp-contract=off -I ../.. 8_exact.cpp -o 8_exact
//   diff 7_lowest_cell.cpp 8_exact.cpp
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "core/overlap.hpp"
#include "read_and_print.hpp"

struct Cell {
  int x, y, z;
};

// The two arrays that are sorted: entry k says that sphere objects[k] lies in cell cell_ids[k].
struct Entries {
  std::vector<std::uint32_t> cell_ids;
  std::vector<std::uint32_t> objects;
};

// ---- 1. Initialisation: space is cut into cubes of side d = 2 r_max.

struct Grid {
  float side;
  Cell first, last;  // the box of all home cells; coordinates outside count as its border
};

int coordinate(const Grid& g, float p) {
  const float cell = std::floor(p / g.side);
  if (!(std::fabs(cell) < 1e9F)) refuse("a sphere lies more than 1e9 cells from the origin");
  return static_cast<int>(cell);
}

Cell home_cell(const Grid& g, const Sphere& s) {
  return {coordinate(g, s.x), coordinate(g, s.y), coordinate(g, s.z)};
}

Grid make_grid(const std::vector<Sphere>& spheres) {
  float r_max = 0;
  for (const Sphere& s : spheres) r_max = std::max(r_max, s.r);
  Grid g = {r_max > 0 ? 2 * r_max : 1, {}, {}};
  g.first = g.last = home_cell(g, spheres[0]);
  for (const Sphere& s : spheres) {
    const Cell home = home_cell(g, s);
    g.first = {std::min(g.first.x, home.x), std::min(g.first.y, home.y),
               std::min(g.first.z, home.z)};
    g.last = {std::max(g.last.x, home.x), std::max(g.last.y, home.y), std::max(g.last.z, home.z)};
  }
  const double nx = 1.0 + g.last.x - g.first.x, ny = 1.0 + g.last.y - g.first.y;
  if (nx * ny * (1.0 + g.last.z - g.first.z) >= kEmpty) refuse("too many cells for ids of 32 bits");
  return g;
}

// ---- 2. Subdivision: which cells does each sphere lie in?

std::uint32_t cell_id(const Grid& g, Cell c) {
  const std::uint32_t nx = 1U + g.last.x - g.first.x, ny = 1U + g.last.y - g.first.y;
  return (c.x - g.first.x) + nx * ((c.y - g.first.y) + ny * (c.z - g.first.z));
}

// The cells that the box around a sphere meets: lowest and highest on each axis.
Cell clamped(const Grid& g, Cell c) {
  return {std::clamp(c.x, g.first.x, g.last.x), std::clamp(c.y, g.first.y, g.last.y),
          std::clamp(c.z, g.first.z, g.last.z)};
}

Cell lowest_cell(const Grid& g, const Sphere& s) {
  return clamped(g, home_cell(g, {s.x - s.r, s.y - s.r, s.z - s.r, s.r}));
}

Cell highest_cell(const Grid& g, const Sphere& s) {
  return clamped(g, home_cell(g, {s.x + s.r, s.y + s.r, s.z + s.r, s.r}));
}

// No slots: a GPU counts each sphere's cells, and a prefix sum says where they go.
Entries list_cells(const Grid& g, const std::vector<Sphere>& spheres) {
  Entries e;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {  // on a GPU: one thread for each sphere
    const std::uint32_t home = cell_id(g, home_cell(g, spheres[i]));
    const Cell low = lowest_cell(g, spheres[i]), high = highest_cell(g, spheres[i]);
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          const std::uint32_t id = cell_id(g, {x, y, z});
          e.cell_ids.push_back(id);
          e.objects.push_back(id == home ? i : i | kPhantom);
        }
      }
    }
  }
  return e;
}

// ---- 3. Radix sort: four passes of 8 bits, lowest digit first, each of three phases.

using Counters = std::array<std::uint32_t, 256>;

std::uint32_t digit(std::uint32_t id, int shift) { return id >> shift & 255; }

// Phase 1: how often does each digit occur?
Counters tabulate(const Entries& e, int shift) {
  Counters counters = {};
  for (std::uint32_t id : e.cell_ids) ++counters[digit(id, shift)];
  return counters;
}

// Phase 2: each counter becomes the sum of those before it: where the digit's first entry goes.
Counters prefix_sum(const Counters& counters) {
  Counters sums = {};
  for (int d = 1; d < 256; ++d) sums[d] = sums[d - 1] + counters[d - 1];
  return sums;
}

// Phase 3: each entry goes to its digit's next place. Equal digits stay in order: it is stable.
Entries reorder(const Entries& e, int shift, Counters places) {
  Entries sorted = e;
  for (std::size_t k = 0; k < e.cell_ids.size(); ++k) {
    const std::uint32_t place = places[digit(e.cell_ids[k], shift)]++;
    sorted.cell_ids[place] = e.cell_ids[k];
    sorted.objects[place] = e.objects[k];
  }
  return sorted;
}

// The index array: where the entries of each cell begin, how many are homes, how many phantoms.
std::vector<IndexEntry> index_cells(const Entries& e) {
  std::vector<IndexEntry> cells;
  for (std::uint32_t k = 0; k < e.cell_ids.size(); ++k) {
    if (k == 0 || e.cell_ids[k] != e.cell_ids[k - 1]) cells.push_back({e.cell_ids[k], k, 0, 0});
    ++(e.objects[k] & kPhantom ? cells.back().phantoms : cells.back().homes);
  }
  return cells;
}

// ---- 4. Collision detection, cell by cell.

bool overlap(const Sphere& a, const Sphere& b) {
  return octocell::overlap_exact({a.x, a.y, a.z, a.r}, {b.x, b.y, b.z, b.r});
}

// Only in the lowest of the cells that both boxes meet.
bool is_tested_here(const Grid& g, std::uint32_t cell, const Sphere& a, const Sphere& b) {
  const Cell i = lowest_cell(g, a), j = lowest_cell(g, b);
  return cell == cell_id(g, {std::max(i.x, j.x), std::max(i.y, j.y), std::max(i.z, j.z)});
}

std::vector<Pair> test_pairs(const Grid& g, const std::vector<Sphere>& spheres, const Entries& e,
                             const std::vector<IndexEntry>& cells) {
  std::vector<Pair> pairs;
  for (const IndexEntry& cell : cells) {  // on a GPU: one thread for each cell
    const std::uint32_t end = cell.begin + cell.homes + cell.phantoms;
    for (std::uint32_t k = cell.begin; k < end; ++k) {
      for (std::uint32_t l = k + 1; l < end; ++l) {
        const std::uint32_t i = e.objects[k] & kNumber, j = e.objects[l] & kNumber;
        if (!is_tested_here(g, cell.cell, spheres[i], spheres[j])) continue;
        if (overlap(spheres[i], spheres[j])) pairs.push_back(std::minmax(i, j));
      }
    }
  }
  return pairs;
}

void print(const char* title, const Entries& e) {
  print_entries(title, e.cell_ids.data(), e.objects.data(), e.cell_ids.size());
}

int main(int argc, char** argv) {
  const std::vector<Sphere> spheres = read_spheres(argc, argv);
  const Grid grid = make_grid(spheres);
  std::printf("%zu spheres, cell side %g\n\n", spheres.size(), grid.side);

  Entries e = list_cells(grid, spheres);
  print("cells of each sphere", e);

  for (int shift = 0; shift < 32; shift += 8) {
    const Counters counters = tabulate(e, shift), sums = prefix_sum(counters);
    e = reorder(e, shift, sums);
    print_counters(shift, counters.data(), sums.data());
    print(" sorted", e);
  }

  const std::vector<IndexEntry> cells = index_cells(e);
  print_cells(cells.data(), cells.size(), e.objects.data());

  std::vector<Pair> pairs = test_pairs(grid, spheres, e, cells);
  std::sort(pairs.begin(), pairs.end());
  print_pairs(pairs.data(), pairs.size());
}
