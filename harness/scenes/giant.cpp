// SPDX-License-Identifier: MIT
// A gas with one huge sphere in the middle of the box: cells made for it would hold most of the
// others.

#include "harness/scenes/families.hpp"

namespace octocell::families {

void giant(const Parameters& parameters, GeneratedSpheres& spheres) {
  gas(parameters, spheres);
  if (spheres.size() == 0) return;
  const double side = box_side(spheres.size(), parameters.real("phi"));
  // Neither the first nor the last, so that no loop handles it correctly by chance.
  spheres.put(spheres.size() / 2, {0.0, 0.0, 0.0, parameters.real("size") * side});
}

}  // namespace octocell::families
