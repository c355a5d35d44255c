// SPDX-License-Identifier: MIT
// Spheres in the densest packing: a face-centred cubic lattice, in which each touches twelve
// others. Coordinates are multiples of spacing / sqrt 2, so rounding moves every contact in one
// direction or the other; a plain float32 test gets some of them wrong.
#include <cmath>
#include <cstddef>

#include "harness/scenes/families.hpp"

namespace octocell::families {
namespace {

/// Returns the smallest even side of a cubic lattice half of whose points are at least `count`.
std::size_t even_side(std::size_t count) {
  std::size_t side = 2;
  while (side * side * side / 2 < count) side += 2;
  return side;
}

}  // namespace

/// Uses the points of a cubic lattice whose coordinates have an even sum.
void fcc(const Parameters& parameters, GeneratedSpheres& spheres) {
  const double spacing = parameters.real("spacing");
  const double step = spacing * std::sqrt(0.5);
  const std::size_t side = even_side(spheres.size());
  const auto coordinate = [&](std::size_t steps) {
    return coordinate_on_lattice(steps, side, step);
  };
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const std::size_t row = i / (side / 2);
    const std::size_t y = row % side;
    const std::size_t z = row / side;
    const std::size_t x = 2 * (i % (side / 2)) + (y + z) % 2;
    spheres.put(i, {coordinate(x), coordinate(y), coordinate(z), spacing * 0.5});
  }
}

}  // namespace octocell::families
