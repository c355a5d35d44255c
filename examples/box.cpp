// SPDX-License-Identifier: MIT
// Pairs in a box that repeats: sphere i, moved by S boxes, meets sphere j.
#include <cstddef>
#include <iostream>
#include <octocell/octocell.hpp>
#include <vector>

int main() {
  const std::vector<octocell::Sphere> spheres = {{0.5F, 5, 5, 1}, {9, 5, 5, 1}, {4.5F, 5, 14, 1}};
  const octocell::Box box = {.vector = {{10, 0, 0}, {0, 10, 0}, {4, 0, 10}}};  // skewed

  const octocell::Pairs pairs = octocell::find_pairs(spheres, {.box = box});
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const octocell::Shift s = pairs.shifts()[k];
    std::cout << pairs[k].i << ' ' << pairs[k].j << "  S = " << s.a << ' ' << s.b << ' ' << s.c
              << '\n';
  }
}
