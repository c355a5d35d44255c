// SPDX-License-Identifier: MIT
// Radii from 0.5 / ratio to 0.5, with each octave equally frequent; placed as in a gas.
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {

template <typename AnySphere>
std::vector<AnySphere> poly(const Parameters& parameters) {
  using Number = NumberOf<AnySphere>;
  std::vector<AnySphere> spheres(parameters.whole("n"));
  const double ratio = parameters.real("ratio");
  const PowerTable power_of_ratio(ratio);
  Random random(parameters.whole("seed"));
  double volume = 0.0;
  for (AnySphere& s : spheres) {
    const double r = kRadius / ratio * power_of_ratio(random.uniform());
    volume += sphere_volume(r);
    s.r = static_cast<Number>(r);
  }
  const double side = cube_root(volume / parameters.real("phi"));
  for (AnySphere& s : spheres) {
    s.x = coordinate_in_box<Number>(random, side);
    s.y = coordinate_in_box<Number>(random, side);
    s.z = coordinate_in_box<Number>(random, side);
  }
  return spheres;
}

template std::vector<Sphere> poly(const Parameters&);
template std::vector<DoubleSphere> poly(const Parameters&);

}  // namespace octocell::families
