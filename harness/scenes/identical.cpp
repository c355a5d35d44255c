// SPDX-License-Identifier: MIT
// The same sphere n times: one cell holds everything, and all n (n - 1) / 2 pairs overlap.

#include <cstddef>

#include "harness/scenes/families.hpp"

namespace octocell::families {

void identical(const Parameters& /*parameters*/, GeneratedSpheres& spheres) {
  for (std::size_t i = 0; i < spheres.size(); ++i) spheres.put(i, {0.0, 0.0, 0.0, kRadius});
}

}  // namespace octocell::families
