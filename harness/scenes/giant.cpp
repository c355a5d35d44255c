// SPDX-License-Identifier: MIT
// A gas with one huge sphere in the middle of the box: cells made for it would hold most of the
// others.
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {

template <typename AnySphere>
std::vector<AnySphere> giant(const Parameters& parameters) {
  std::vector<AnySphere> spheres = gas<AnySphere>(parameters);
  if (spheres.empty()) return spheres;
  const double side = box_side(spheres.size(), parameters.real("phi"));
  // Neither the first nor the last, so that no loop handles it correctly by chance.
  spheres[spheres.size() / 2] = {0, 0, 0,
                                 static_cast<NumberOf<AnySphere>>(parameters.real("size") * side)};
  return spheres;
}

template std::vector<Sphere> giant(const Parameters&);
template std::vector<DoubleSphere> giant(const Parameters&);

}  // namespace octocell::families
