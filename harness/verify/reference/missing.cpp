// SPDX-License-Identifier: MIT
// Replaces the reference in a build without GMP (OCTOCELL_JUDGE=OFF). Commands call
// require_available() before they begin, so the other functions are never called.
#include <span>
#include <vector>

#include "core/error.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {

void require_available() {
  throw LimitError("this build (OCTOCELL_DEVELOPER=OFF) has no exact answers to compare with");
}

std::vector<Pair> exact_pairs(std::span<const Sphere> /*spheres*/, AllFlags /*flags*/) {
  require_available();
  return {};
}

RoundingEffect rounding_effect(std::span<const DoubleSphere> /*unrounded*/, AllFlags /*flags*/,
                               std::span<const Pair> /*pairs_of_rounded*/) {
  require_available();
  return {};
}

DepthErrors depth_errors(std::span<const float> /*depths*/, std::span<const Pair> /*pairs*/,
                         std::span<const Sphere> /*spheres*/) {
  require_available();
  return {};
}

}  // namespace octocell::reference
