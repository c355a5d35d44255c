// SPDX-License-Identifier: MIT
// Equal spheres, placed uniformly and independently. The box is centred on the origin, so
// coordinates have both signs.
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {
namespace {

template <typename AnySphere>
std::vector<AnySphere> gas_around(const Parameters& parameters, double centre) {
  using Number = NumberOf<AnySphere>;
  std::vector<AnySphere> spheres(parameters.whole("n"));
  const double side = box_side(spheres.size(), parameters.real("phi"));
  Random random(parameters.whole("seed"));
  for (AnySphere& s : spheres) {
    s.x = coordinate_in_box<Number>(random, side, centre);
    s.y = coordinate_in_box<Number>(random, side, centre);
    s.z = coordinate_in_box<Number>(random, side, centre);
    s.r = static_cast<Number>(kRadius);
  }
  return spheres;
}

}  // namespace

template <typename AnySphere>
std::vector<AnySphere> gas(const Parameters& parameters) {
  return gas_around<AnySphere>(parameters, 0.0);
}

// Far from the origin, floats are coarse: many spheres share coordinates, and box corners are
// rounded.
template <typename AnySphere>
std::vector<AnySphere> shifted(const Parameters& parameters) {
  return gas_around<AnySphere>(parameters, parameters.real("offset"));
}

template std::vector<Sphere> gas(const Parameters&);
template std::vector<DoubleSphere> gas(const Parameters&);
template std::vector<Sphere> shifted(const Parameters&);
template std::vector<DoubleSphere> shifted(const Parameters&);

}  // namespace octocell::families
