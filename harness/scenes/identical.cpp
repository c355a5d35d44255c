// SPDX-License-Identifier: MIT
// The same sphere n times: one cell holds everything, and all n (n - 1) / 2 pairs overlap.
#include <vector>

#include "harness/scenes/families.hpp"

namespace octocell::families {

template <typename AnySphere>
std::vector<AnySphere> identical(const Parameters& parameters) {
  const AnySphere one{0, 0, 0, static_cast<NumberOf<AnySphere>>(kRadius)};
  return std::vector<AnySphere>(parameters.whole("n"), one);
}

template std::vector<Sphere> identical(const Parameters&);
template std::vector<DoubleSphere> identical(const Parameters&);

}  // namespace octocell::families
