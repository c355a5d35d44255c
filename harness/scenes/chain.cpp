// SPDX-License-Identifier: MIT
// Spheres in a row along x. With the preset spacing each touches the next exactly: n - 1 pairs.
#include <cstddef>
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {

template <typename AnySphere>
std::vector<AnySphere> chain(const Parameters& parameters) {
  using Number = NumberOf<AnySphere>;
  std::vector<AnySphere> spheres(parameters.whole("n"));
  const double spacing = parameters.real("spacing");
  const auto middle = static_cast<double>(spheres.size() / 2);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double x = (static_cast<double>(i) - middle) * spacing;
    spheres[i] = {static_cast<Number>(x), 0, 0, static_cast<Number>(kRadius)};
  }
  return spheres;
}

template std::vector<Sphere> chain(const Parameters&);
template std::vector<DoubleSphere> chain(const Parameters&);

}  // namespace octocell::families
