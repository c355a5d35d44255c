// SPDX-License-Identifier: MIT
// A cubic lattice of spheres that touch their neighbours exactly, if the spacing is a short binary
// number such as 1 or 0.25. With 0.1, rounding moves the contacts in one direction or the other.
#include <cstddef>

#include "harness/scenes/families.hpp"

namespace octocell::families {
namespace {

/// Returns the smallest s with s^3 >= count.
std::size_t cube_side(std::size_t count) {
  std::size_t side = 0;
  while (side * side * side < count) ++side;
  return side;
}

void shuffle(GeneratedSpheres& spheres, Random random) {
  for (std::size_t left = spheres.size(); left > 1; --left) {
    spheres.swap(left - 1, random.below(left));
  }
}

}  // namespace

void lattice(const Parameters& parameters, GeneratedSpheres& spheres) {
  const double spacing = parameters.real("spacing");
  const std::size_t side = cube_side(spheres.size());
  const auto coordinate = [&](std::size_t steps) {
    return coordinate_on_lattice(steps, side, spacing);
  };
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    spheres.put(i, {coordinate(i % side), coordinate(i / side % side), coordinate(i / side / side),
                    spacing * 0.5});
  }
  if (parameters.whole("shuffle") == 1) shuffle(spheres, Random(parameters.whole("seed")));
}

}  // namespace octocell::families
