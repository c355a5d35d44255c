// SPDX-License-Identifier: MIT
// Step 6: chapter 32's control bits in place of "the phantom's home is larger".
//
// wins back  pairs in which only the sphere with the smaller home reaches the other home
// why        a pair is left to another cell only if both lie there, it is the home of one of them,
//            and it is of lower type; types are parities, and side 1.5 keeps equal ones apart
// cost       eleven bits a sphere: the type of its home, the types of all cells that it meets
//
//   g++ -std=c++20 -O2 -ffp-contract=off 6_control_bits.cpp -o 6_control_bits
//   diff 5_scaled_balls.cpp 6_control_bits.cpp
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "read_and_print.hpp"

struct Cell {
  int x, y, z;
};

constexpr std::uint32_t kSlots = 8;    // a sphere: its home cell and seven phantoms
constexpr float kScale = 1.41421366F;  // the root of 2, rounded up

// The two arrays that are sorted: entry k says that sphere objects[k] lies in cell cell_ids[k].
struct Entries {
  std::vector<std::uint32_t> cell_ids;
  std::vector<std::uint32_t> objects;
};

// ---- 1. Initialisation: space is cut into cubes of side d = 1.5 times the scaled diameter.

struct Grid {
  float side;
  Cell first, last;  // the box of all home cells; cells outside are left out, they hold no home
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
  Grid g = {r_max > 0 ? 1.5F * 2 * kScale * r_max : 1, {}, {}};
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

// How far p lies outside the slab of cells with coordinate c.
float gap(const Grid& g, int c, float p) {
  const float low = static_cast<float>(c) * g.side, high = low + g.side;
  if (p < low) return low - p;
  return p > high ? p - high : 0;
}

bool ball_meets(const Grid& g, Cell c, const Sphere& s) {
  const float x = gap(g, c.x, s.x), y = gap(g, c.y, s.y), z = gap(g, c.z, s.z);
  const float r = kScale * s.r;
  return x * x + y * y + z * z <= r * r;
}

bool is_inside(const Grid& g, Cell c) {
  return c.x >= g.first.x && c.x <= g.last.x && c.y >= g.first.y && c.y <= g.last.y &&
         c.z >= g.first.z && c.z <= g.last.z;
}

// Slot 8i holds the home cell of sphere i, slots 8i + 1 to 8i + 7 its phantom cells.
Entries list_cells(const Grid& g, const std::vector<Sphere>& spheres) {
  Entries e = {std::vector<std::uint32_t>(spheres.size() * kSlots, kEmpty),
               std::vector<std::uint32_t>(spheres.size() * kSlots, kEmpty)};
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {  // on a GPU: one thread for each sphere
    const Cell home = home_cell(g, spheres[i]);
    std::uint32_t slot = kSlots * i;
    e.cell_ids[slot] = cell_id(g, home);
    e.objects[slot++] = i;
    for (int neighbour = 0; neighbour < 27 && slot < kSlots * (i + 1); ++neighbour) {
      const int dx = neighbour % 3 - 1, dy = neighbour / 3 % 3 - 1, dz = neighbour / 9 - 1;
      const Cell c = {home.x + dx, home.y + dy, home.z + dz};
      if (dx == 0 && dy == 0 && dz == 0) continue;
      if (!is_inside(g, c) || !ball_meets(g, c, spheres[i])) continue;
      e.cell_ids[slot] = cell_id(g, c);
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

// The type of a cell: the parities of its coordinates, one of 0 to 7.
int type_of(Cell c) { return (c.x & 1) | (c.y & 1) << 1 | (c.z & 1) << 2; }

struct ControlBits {
  int home_type;
  int types_met;  // bit t: the sphere is listed in a cell of type t
};

std::vector<ControlBits> control_bits(const Grid& g, const std::vector<Sphere>& spheres) {
  std::vector<ControlBits> bits;
  for (const Sphere& s : spheres) {
    const Cell home = home_cell(g, s);
    bits.push_back({type_of(home), 1 << type_of(home)});
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const Cell c = {home.x + neighbour % 3 - 1, home.y + neighbour / 3 % 3 - 1,
                      home.z + neighbour / 9 - 1};
      if (is_inside(g, c) && ball_meets(g, c, s)) bits.back().types_met |= 1 << type_of(c);
    }
  }
  return bits;
}

// Not where both are phantoms, and not if the home of one of them, of lower type, holds both.
bool is_tested_here(const std::vector<ControlBits>& bits, std::uint32_t a, std::uint32_t b) {
  if (a & b & kPhantom) return false;
  const ControlBits i = bits[a & kNumber], j = bits[b & kNumber];
  const int here = a & kPhantom ? j.home_type : i.home_type;
  const int both = i.types_met & j.types_met;
  const auto is_elsewhere = [&](int type) { return type < here && (both >> type & 1); };
  return !is_elsewhere(i.home_type) && !is_elsewhere(j.home_type);
}

std::vector<Pair> test_pairs(const Grid& g, const std::vector<Sphere>& spheres, const Entries& e,
                             const std::vector<IndexEntry>& cells) {
  const std::vector<ControlBits> bits = control_bits(g, spheres);
  std::vector<Pair> pairs;
  for (const IndexEntry& cell : cells) {  // on a GPU: one thread for each cell
    const std::uint32_t end = cell.begin + cell.homes + cell.phantoms;
    for (std::uint32_t k = cell.begin; k < end; ++k) {
      for (std::uint32_t l = k + 1; l < end; ++l) {
        if (!is_tested_here(bits, e.objects[k], e.objects[l])) continue;
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
