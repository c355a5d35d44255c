// SPDX-License-Identifier: MIT
// A scene that moves: one Finder keeps its memory and its threads from frame to frame.
#include <cstddef>
#include <iostream>
#include <octocell/octocell.hpp>
#include <vector>

int main() {
  std::vector<octocell::Sphere> spheres;
  for (int k = 0; k < 1000; ++k) spheres.push_back({static_cast<float>(3 * k), 0, 0, 1});

  octocell::Finder finder;
  for (int frame = 0; frame < 4; ++frame) {
    std::cout << "frame " << frame << ": " << finder.find(spheres).size() << " pairs\n";
    for (std::size_t k = 0; k < spheres.size(); k += 2) spheres[k].x += 0.5F;
  }
  const octocell::Pairs last = finder.take();  // keeps them; moves no pair
  std::cout << "the last pair: " << last[last.size() - 1].i << ' ' << last[last.size() - 1].j
            << '\n';
}
