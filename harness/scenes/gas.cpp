// SPDX-License-Identifier: MIT
// Equal spheres, placed uniformly and independently. The box is centred on the origin, so
// coordinates have both signs.

#include <cstddef>

#include "harness/scenes/families.hpp"

namespace octocell::families {
namespace {

void gas_around(const Parameters& parameters, double centre, GeneratedSpheres& spheres) {
  const double side = box_side(spheres.size(), parameters.real("phi"));
  Random random(parameters.whole("seed"));
  const auto coordinate = [&] { return coordinate_in_box(random, side, centre); };
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    spheres.put(i, {coordinate(), coordinate(), coordinate(), kRadius});
  }
}

}  // namespace

void gas(const Parameters& parameters, GeneratedSpheres& spheres) {
  gas_around(parameters, 0.0, spheres);
}

// Far from the origin, floats are coarse: many spheres share coordinates, and box corners are
// rounded.
void shifted(const Parameters& parameters, GeneratedSpheres& spheres) {
  gas_around(parameters, parameters.real("offset"), spheres);
}

}  // namespace octocell::families
