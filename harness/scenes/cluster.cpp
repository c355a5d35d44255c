// SPDX-License-Identifier: MIT
// Most spheres are in bell-shaped clouds around a few centres, the rest is spread over the box. So
// cells hold very different numbers of spheres.
#include <cmath>
#include <numbers>
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {
namespace {

/// Returns the standard deviation with which a cloud of `count` spheres has the volume fraction
/// `peak` at its centre. There the density of a normal distribution is count / ((2 pi)^(3/2)
/// width^3).
double cloud_width(double count, double peak) {
  const double two_pi = 2.0 * std::numbers::pi;
  return cube_root(count * sphere_volume(kRadius) / (peak * two_pi * std::sqrt(two_pi)));
}

}  // namespace

template <typename AnySphere>
std::vector<AnySphere> cluster(const Parameters& parameters) {
  using Number = NumberOf<AnySphere>;
  std::vector<AnySphere> spheres(parameters.whole("n"));
  const double side = box_side(spheres.size(), parameters.real("phi"));
  const double share = parameters.real("share");
  const auto in_clouds = share * static_cast<double>(spheres.size());
  std::vector<Sphere> centres(parameters.whole("clusters"));
  const double width =
      cloud_width(in_clouds / static_cast<double>(centres.size()), parameters.real("peak"));

  Random random(parameters.whole("seed"));
  for (Sphere& centre : centres) {
    centre.x = coordinate_in_box<float>(random, side);
    centre.y = coordinate_in_box<float>(random, side);
    centre.z = coordinate_in_box<float>(random, side);
  }
  for (AnySphere& s : spheres) {
    s.r = static_cast<Number>(kRadius);
    if (random.uniform() < share) {
      const Sphere& centre = centres[random.below(centres.size())];
      s.x = static_cast<Number>(centre.x + width * random.bell());
      s.y = static_cast<Number>(centre.y + width * random.bell());
      s.z = static_cast<Number>(centre.z + width * random.bell());
      continue;
    }
    s.x = coordinate_in_box<Number>(random, side);
    s.y = coordinate_in_box<Number>(random, side);
    s.z = coordinate_in_box<Number>(random, side);
  }
  return spheres;
}

template std::vector<Sphere> cluster(const Parameters&);
template std::vector<DoubleSphere> cluster(const Parameters&);

}  // namespace octocell::families
