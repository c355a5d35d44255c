// SPDX-License-Identifier: MIT
// The course text as a program: one function for each step of the text, its mistakes included.
//
//   g++ -std=c++20 -O2 -ffp-contract=off 1_as_written.cpp -o 1_as_written
//   ./1_as_written ../scenes/eight.csv
//
// Reads lines of x,y,z,r and prints every array: the cell ids, each pass of the sort, the cell
// index, the pairs. The steps 2 to 8 beside this file mend one mistake each; `diff` shows how.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "read_and_print.hpp"

struct Cell {
  std::uint32_t x, y, z;
};

constexpr std::uint32_t kSlots = 8;  // a sphere: its home cell and seven phantoms
constexpr int kXShift = 0, kYShift = 10, kZShift = 20;

// The two arrays that are sorted: entry k says that sphere objects[k] lies in cell cell_ids[k].
struct Entries {
  std::vector<std::uint32_t> cell_ids;
  std::vector<std::uint32_t> objects;
};

// ---- 1. Initialisation: space is cut into cubes of side d = 1.5 r_max.

struct Grid {
  float side;
};

Grid make_grid(const std::vector<Sphere>& spheres) {
  float r_max = 0;
  for (const Sphere& s : spheres) r_max = std::max(r_max, s.r);
  return {1.5F * r_max};
}

// ---- 2. Subdivision: which cells does each sphere lie in?

// (GLuint)value. C++ leaves a negative value undefined; this is what a GPU does: it gives 0.
std::uint32_t to_unsigned(float value) {
  if (!(value > 0)) return 0;
  return value >= 4294967296.0F ? 0xffffffff : static_cast<std::uint32_t>(value);
}

Cell home_cell(const Grid& g, const Sphere& s) {
  return {to_unsigned(s.x / g.side), to_unsigned(s.y / g.side), to_unsigned(s.z / g.side)};
}

std::uint32_t cell_id(Cell c) { return c.x << kXShift | c.y << kYShift | c.z << kZShift; }

// How far p lies outside the slab of cells with coordinate c.
float gap(const Grid& g, std::uint32_t c, float p) {
  const float low = static_cast<float>(c) * g.side, high = low + g.side;
  if (p < low) return low - p;
  return p > high ? p - high : 0;
}

bool ball_meets(const Grid& g, Cell c, const Sphere& s) {
  const float x = gap(g, c.x, s.x), y = gap(g, c.y, s.y), z = gap(g, c.z, s.z);
  return x * x + y * y + z * z <= s.r * s.r;
}

// The neighbour one step away, unless it would lie outside the numbers of cells.
bool step(std::uint32_t& at, int by) {
  if (by < 0 ? at == 0 : by > 0 && at == 0xffffffff) return false;
  at += static_cast<std::uint32_t>(by);
  return true;
}

// Slot 8i holds the home cell of sphere i, slots 8i + 1 to 8i + 7 its phantom cells.
Entries list_cells(const Grid& g, const std::vector<Sphere>& spheres) {
  Entries e = {std::vector<std::uint32_t>(spheres.size() * kSlots, kEmpty),
               std::vector<std::uint32_t>(spheres.size() * kSlots, kEmpty)};
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {  // on a GPU: one thread for each sphere
    const Cell home = home_cell(g, spheres[i]);
    std::uint32_t slot = kSlots * i;
    e.cell_ids[slot] = cell_id(home);
    e.objects[slot++] = i;
    for (int neighbour = 0; neighbour < 27 && slot < kSlots * (i + 1); ++neighbour) {
      const int dx = neighbour % 3 - 1, dy = neighbour / 3 % 3 - 1, dz = neighbour / 9 - 1;
      Cell c = home;
      if (dx == 0 && dy == 0 && dz == 0) continue;
      if (!step(c.x, dx) || !step(c.y, dy) || !step(c.z, dz)) continue;
      if (!ball_meets(g, c, spheres[i])) continue;
      e.cell_ids[slot] = cell_id(c);
      e.objects[slot++] = i | kPhantom;
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
  for (std::uint32_t k = 0; k < e.cell_ids.size() && e.cell_ids[k] != kEmpty; ++k) {
    if (k == 0 || e.cell_ids[k] != e.cell_ids[k - 1]) cells.push_back({e.cell_ids[k], k, 0, 0});
    ++(e.objects[k] & kPhantom ? cells.back().phantoms : cells.back().homes);
  }
  return cells;
}

// ---- 4. Collision detection, cell by cell.

bool overlap(const Sphere& a, const Sphere& b) {
  const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z, r = a.r + b.r;
  return x * x + y * y + z * z <= r * r;
}

// Home with home always; home with phantom only if the phantom's home has the larger id.
bool is_tested_here(const Grid& g, const std::vector<Sphere>& spheres, std::uint32_t a,
                    std::uint32_t b) {
  if (a & b & kPhantom) return false;
  if (!((a | b) & kPhantom)) return true;
  const std::uint32_t home = a & kPhantom ? b : a, phantom = a & kPhantom ? a : b;
  return cell_id(home_cell(g, spheres[phantom & kNumber])) > cell_id(home_cell(g, spheres[home]));
}

std::vector<Pair> test_pairs(const Grid& g, const std::vector<Sphere>& spheres, const Entries& e,
                             const std::vector<IndexEntry>& cells) {
  std::vector<Pair> pairs;
  for (const IndexEntry& cell : cells) {  // on a GPU: one thread for each cell
    const std::uint32_t end = cell.begin + cell.homes + cell.phantoms;
    for (std::uint32_t k = cell.begin; k < end; ++k) {
      for (std::uint32_t l = k + 1; l < end; ++l) {
        if (!is_tested_here(g, spheres, e.objects[k], e.objects[l])) continue;
        const std::uint32_t i = e.objects[k] & kNumber, j = e.objects[l] & kNumber;
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
