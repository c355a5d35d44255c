// SPDX-License-Identifier: MIT
// All pairs of a scene.
#include <iostream>
#include <octocell/octocell.hpp>
#include <vector>

int main() {
  const std::vector<octocell::Sphere> spheres = {
      {0, 0, 0, 1}, {3.5, 3, 0, 1}, {5, 2, 0, 1}, {5, 4, 0, 1}};
  for (const octocell::Pair& pair : octocell::find_pairs(spheres)) {
    std::cout << pair.i << ' ' << pair.j << '\n';
  }
}
