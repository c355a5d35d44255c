// SPDX-License-Identifier: MIT
// Spheres in a row along x. With the preset spacing each touches the next exactly: n - 1 pairs.
#include <cstddef>

#include "harness/scenes/families.hpp"

namespace octocell::families {

void chain(const Parameters& parameters, GeneratedSpheres& spheres) {
  const double spacing = parameters.real("spacing");
  const auto middle = static_cast<double>(spheres.size() / 2);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double x = (static_cast<double>(i) - middle) * spacing;
    spheres.put(i, {x, 0.0, 0.0, kRadius});
  }
}

}  // namespace octocell::families
