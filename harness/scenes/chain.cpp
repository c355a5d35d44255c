// SPDX-License-Identifier: MIT
// Spheres in a row along x; with the preset spacing each touches the next exactly: n - 1 pairs.
#include "harness/scenes/families.hpp"

namespace octocell::families {

std::vector<Sphere> chain(const Parameters& parameters) {
  std::vector<Sphere> spheres(parameters.whole("n"));
  const double spacing = parameters.real("spacing");
  const auto middle = static_cast<double>(spheres.size() / 2);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double x = (static_cast<double>(i) - middle) * spacing;
    spheres[i] = {static_cast<float>(x), 0.0F, 0.0F, static_cast<float>(kRadius)};
  }
  return spheres;
}

}  // namespace octocell::families
