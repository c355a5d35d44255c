// SPDX-License-Identifier: MIT
// The same sphere n times: one cell holds everything, and all n (n - 1) / 2 pairs overlap.
#include "harness/scenes/families.hpp"

namespace octocell::families {

std::vector<Sphere> identical(const Parameters& parameters) {
  const Sphere one{0.0F, 0.0F, 0.0F, static_cast<float>(kRadius)};
  return std::vector<Sphere>(parameters.whole("n"), one);
}

}  // namespace octocell::families
