// SPDX-License-Identifier: MIT
// A gas, one sphere of which is huge and sits in the middle of the box: cells made to its measure
// would hold most of the others.
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {

template <typename AnySphere>
std::vector<AnySphere> giant(const Parameters& parameters) {
  std::vector<AnySphere> spheres = gas<AnySphere>(parameters);
  if (spheres.empty()) return spheres;
  const double side = box_side(spheres.size(), parameters.real("phi"));
  // Neither the first nor the last, so that no loop meets it by luck of order.
  spheres[spheres.size() / 2] = {0, 0, 0,
                                 static_cast<NumberOf<AnySphere>>(parameters.real("size") * side)};
  return spheres;
}

template std::vector<Sphere> giant(const Parameters&);
template std::vector<DoubleSphere> giant(const Parameters&);

}  // namespace octocell::families
