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

void cluster(const Parameters& parameters, GeneratedSpheres& spheres) {
  const double side = box_side(spheres.size(), parameters.real("phi"));
  const double share = parameters.real("share");
  const auto in_clouds = share * static_cast<double>(spheres.size());
  std::vector<Sphere> centres(parameters.whole("clusters"));
  const double width =
      cloud_width(in_clouds / static_cast<double>(centres.size()), parameters.real("peak"));

  Random random(parameters.whole("seed"));
  const auto coordinate = [&] { return coordinate_in_box(random, side); };
  for (Sphere& centre : centres) {
    centre = rounded({coordinate(), coordinate(), coordinate(), 0.0});
  }
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (random.uniform() < share) {
      const Sphere& centre = centres[random.below(centres.size())];
      const auto near = [&](float middle) { return middle + width * random.bell(); };
      spheres.put(i, {near(centre.x), near(centre.y), near(centre.z), kRadius});
    } else {
      spheres.put(i, {coordinate(), coordinate(), coordinate(), kRadius});
    }
  }
}

}  // namespace octocell::families
