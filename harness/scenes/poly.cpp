// SPDX-License-Identifier: MIT
// Radii from 0.5 / ratio to 0.5, each octave equally often; placed as in a gas.
#include "harness/scenes/families.hpp"

namespace octocell::families {

std::vector<Sphere> poly(const Parameters& parameters) {
  std::vector<Sphere> spheres(parameters.whole("n"));
  const double ratio = parameters.real("ratio");
  const PowerTable power_of_ratio(ratio);
  Random random(parameters.whole("seed"));
  double volume = 0.0;
  for (Sphere& s : spheres) {
    const double r = kRadius / ratio * power_of_ratio(random.uniform());
    volume += sphere_volume(r);
    s.r = static_cast<float>(r);
  }
  const double side = cube_root(volume / parameters.real("phi"));
  for (Sphere& s : spheres) {
    s.x = coordinate_in_box(random, side);
    s.y = coordinate_in_box(random, side);
    s.z = coordinate_in_box(random, side);
  }
  return spheres;
}

}  // namespace octocell::families
