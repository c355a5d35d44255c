// SPDX-License-Identifier: MIT
// Equal spheres, placed uniformly and without regard to one another. The box is centred on the
// origin, so coordinates have both signs.
#include "harness/scenes/families.hpp"

namespace octocell::families {
namespace {

std::vector<Sphere> gas_around(const Parameters& parameters, double centre) {
  std::vector<Sphere> spheres(parameters.whole("n"));
  const double side = box_side(spheres.size(), parameters.real("phi"));
  Random random(parameters.whole("seed"));
  for (Sphere& s : spheres) {
    s.x = coordinate_in_box(random, side, centre);
    s.y = coordinate_in_box(random, side, centre);
    s.z = coordinate_in_box(random, side, centre);
    s.r = static_cast<float>(kRadius);
  }
  return spheres;
}

}  // namespace

std::vector<Sphere> gas(const Parameters& parameters) { return gas_around(parameters, 0.0); }

// Far from the origin floats are coarse: many spheres share coordinates, and box corners round.
std::vector<Sphere> shifted(const Parameters& parameters) {
  return gas_around(parameters, parameters.real("offset"));
}

}  // namespace octocell::families
