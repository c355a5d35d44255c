// SPDX-License-Identifier: MIT
// A flat scene (z = 0) with radii that follow a power law: many small ones, few large ones.
#include <cmath>
#include <numbers>
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {

template <typename AnySphere>
std::vector<AnySphere> discs(const Parameters& parameters) {
  using Number = NumberOf<AnySphere>;
  std::vector<AnySphere> spheres(parameters.whole("n"));
  const double ratio = parameters.real("ratio");
  const double smallest = kRadius / ratio;
  // For a density like r^-3, one square root inverts the distribution function.
  const double span = 1.0 - 1.0 / (ratio * ratio);
  Random random(parameters.whole("seed"));
  double area = 0.0;
  for (AnySphere& s : spheres) {
    const double r = smallest / std::sqrt(1.0 - random.uniform() * span);
    area += std::numbers::pi * r * r;
    s.r = static_cast<Number>(r);
  }
  const double side = std::sqrt(area / parameters.real("phi"));
  for (AnySphere& s : spheres) {
    s.x = coordinate_in_box<Number>(random, side);
    s.y = coordinate_in_box<Number>(random, side);
    s.z = 0;
  }
  return spheres;
}

template std::vector<Sphere> discs(const Parameters&);
template std::vector<DoubleSphere> discs(const Parameters&);

}  // namespace octocell::families
