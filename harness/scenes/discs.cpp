// SPDX-License-Identifier: MIT
// A flat scene (z = 0) with radii that follow a power law: many small ones, few large ones.
#include <cmath>
#include <cstddef>
#include <numbers>

#include "harness/scenes/families.hpp"

namespace octocell::families {

void discs(const Parameters& parameters, GeneratedSpheres& spheres) {
  const double ratio = parameters.real("ratio");
  const double smallest = kRadius / ratio;
  // For a density like r^-3, one square root inverts the distribution function.
  const double span = 1.0 - 1.0 / (ratio * ratio);
  Random random(parameters.whole("seed"));
  double area = 0.0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double r = smallest / std::sqrt(1.0 - random.uniform() * span);
    area += std::numbers::pi * r * r;
    spheres.put_radius(i, r);
  }
  const double side = std::sqrt(area / parameters.real("phi"));
  const auto coordinate = [&] { return coordinate_in_box(random, side); };
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    spheres.put_centre(i, {coordinate(), coordinate(), 0.0});
  }
}

}  // namespace octocell::families
