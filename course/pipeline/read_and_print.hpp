// SPDX-License-Identifier: MIT
// What every step of this folder shares, and what is not its subject: reading spheres, printing
// arrays. Entries whose id is kEmpty hold no cell and are not printed.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

struct Sphere {
  float x, y, z, r;
};

// An object is the number of a sphere; its highest bit, the control bit, says "phantom".
constexpr std::uint32_t kPhantom = 0x80000000;
constexpr std::uint32_t kNumber = kPhantom - 1;
constexpr std::uint32_t kEmpty = 0xffffffff;  // the cell id of a slot that holds no cell

// Where the entries of a cell begin, how many are homes, how many phantoms.
struct IndexEntry {
  std::uint32_t cell, begin, homes, phantoms;
};
using Pair = std::pair<std::uint32_t, std::uint32_t>;

[[noreturn]] inline void refuse(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(2);
}

/// Reads lines of x,y,z,r; '#' begins a comment, a line that begins with x is the heading.
inline std::vector<Sphere> read_spheres(int argc, char** argv) {
  if (argc != 2) refuse("usage: give one file of lines x,y,z,r");
  const std::string path = argv[1];
  std::ifstream file(path);
  std::vector<Sphere> spheres;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line[0] == '#' || line[0] == 'x') continue;
    Sphere s;
    char rest;
    if (std::sscanf(line.c_str(), "%f,%f,%f,%f %c", &s.x, &s.y, &s.z, &s.r, &rest) != 4 ||
        !std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.z) || !std::isfinite(s.r) ||
        s.r < 0) {
      refuse(path + ":" + std::to_string(number) + ": not four finite numbers x,y,z,r, r >= 0");
    }
    spheres.push_back(s);
  }
  if (spheres.empty()) refuse(path + ": no spheres here");
  return spheres;
}

inline void print_entries(const char* title, const std::uint32_t* cell_ids,
                          const std::uint32_t* objects, std::size_t size) {
  std::printf("%s\n", title);
  for (std::size_t k = 0; k < size; ++k) {
    if (cell_ids[k] == kEmpty) continue;
    std::printf("  [%zu] cell %u: sphere %u %s\n", k, cell_ids[k], objects[k] & kNumber,
                (objects[k] & kPhantom) != 0 ? "phantom" : "home");
  }
}

/// Prints a table of 256 counters and their prefix sums, without the digits that do not occur.
inline void print_counters(int shift, const std::uint32_t* counts, const std::uint32_t* sums) {
  std::printf("\nsort by bits %d to %d\n", shift, shift + 7);
  for (int d = 0; d < 256; ++d) {
    if (counts[d] > 0) std::printf("  digit %d: %u entries from place %u\n", d, counts[d], sums[d]);
  }
}

/// Prints the cells that hold something, and where the text's belief fails that a stable sort puts
/// homes first.
inline void print_cells(const IndexEntry* cells, std::size_t size, const std::uint32_t* objects) {
  std::printf("\ncell index\n");
  for (std::size_t k = 0; k < size; ++k) {
    const IndexEntry& c = cells[k];
    if (c.homes + c.phantoms == 0) continue;
    std::printf("  cell %u: begins at %u, H = %u, P = %u\n", c.cell, c.begin, c.homes, c.phantoms);
    if (c.homes > 0 && (objects[c.begin] & kPhantom) != 0)
      std::printf("    here a phantom stands before a home\n");
  }
}

inline void print_pairs(const Pair* pairs, std::size_t size) {
  std::printf("\n%zu pairs\n", size);
  for (std::size_t k = 0; k < size; ++k) std::printf("  %u %u\n", pairs[k].first, pairs[k].second);
}
