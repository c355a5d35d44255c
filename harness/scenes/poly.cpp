// SPDX-License-Identifier: MIT
// Radii from 0.5 / ratio to 0.5, with each octave equally frequent; placed as in a gas.

#include <cstddef>

#include "harness/scenes/families.hpp"

namespace octocell::families {

void poly(const Parameters& parameters, GeneratedSpheres& spheres) {
  const double ratio = parameters.real("ratio");
  const PowerTable power_of_ratio(ratio);
  Random random(parameters.whole("seed"));
  double volume = 0.0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double r = kRadius / ratio * power_of_ratio(random.uniform());
    volume += sphere_volume(r);
    spheres.put_radius(i, r);
  }
  const double side = cube_root(volume / parameters.real("phi"));
  const auto coordinate = [&] { return coordinate_in_box(random, side); };
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    spheres.put_centre(i, {coordinate(), coordinate(), coordinate()});
  }
}

}  // namespace octocell::families
