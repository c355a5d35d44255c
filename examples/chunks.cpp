// SPDX-License-Identifier: MIT
// More pairs than memory should hold: a part of the list at a time.
#include <cstdint>
#include <iostream>
#include <octocell/octocell.hpp>
#include <vector>

int main() {
  const std::vector<octocell::Sphere> spheres(3000, {0, 0, 0, 1});  // all overlap

  std::uint64_t pairs = 0;
  for (const octocell::Pairs& chunk : octocell::Chunks(spheres, 1'000'000)) {
    pairs += chunk.size();  // at most a million, sorted, behind those of the chunk before
  }
  std::cout << pairs << " pairs, and " << octocell::count(spheres) << " counted\n";
}
