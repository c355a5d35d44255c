// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "harness/interface/faults.hpp"
#include "harness/interface/sphere.hpp"

namespace octocell::cpu::coherence {

/// The two halves of a sphere, compared without a branch.
inline bool same_bits(const Sphere& a, const Sphere& b) {
  std::array<std::uint64_t, 2> x;
  std::array<std::uint64_t, 2> y;
  std::memcpy(x.data(), &a, sizeof a);
  std::memcpy(y.data(), &b, sizeof b);
  return ((x[0] ^ y[0]) |
          OCTOCELL_FAULT(frame_ignores_radius, (x[1] ^ y[1]) & 0xffffffffU, x[1] ^ y[1])) == 0;
}

}  // namespace octocell::cpu::coherence
