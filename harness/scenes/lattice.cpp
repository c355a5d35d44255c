// SPDX-License-Identifier: MIT
// A cubic lattice of spheres that touch their neighbours exactly, if the spacing is a short binary
// number such as 1 or 0.25. With 0.1, rounding moves the contacts in one direction or the other.
#include <cstddef>
#include <utility>
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {
namespace {

/// Returns the smallest s with s^3 >= count.
std::size_t cube_side(std::size_t count) {
  std::size_t side = 0;
  while (side * side * side < count) ++side;
  return side;
}

template <typename AnySphere>
void shuffle(std::vector<AnySphere>& spheres, Random random) {
  for (std::size_t left = spheres.size(); left > 1; --left) {
    std::swap(spheres[left - 1], spheres[random.below(left)]);
  }
}

}  // namespace

template <typename AnySphere>
std::vector<AnySphere> lattice(const Parameters& parameters) {
  using Number = NumberOf<AnySphere>;
  std::vector<AnySphere> spheres(parameters.whole("n"));
  const double spacing = parameters.real("spacing");
  const std::size_t side = cube_side(spheres.size());
  const auto coordinate = [&](std::size_t steps) {
    return coordinate_on_lattice<Number>(steps, side, spacing);
  };
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    spheres[i].x = coordinate(i % side);
    spheres[i].y = coordinate(i / side % side);
    spheres[i].z = coordinate(i / side / side);
    spheres[i].r = static_cast<Number>(spacing * 0.5);
  }
  if (parameters.whole("shuffle") == 1) shuffle(spheres, Random(parameters.whole("seed")));
  return spheres;
}

template std::vector<Sphere> lattice(const Parameters&);
template std::vector<DoubleSphere> lattice(const Parameters&);

}  // namespace octocell::families
