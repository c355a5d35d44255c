// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell {

/// Compares bit for bit: -0 differs from 0, and a NaN equals itself. Compares two halves without a
/// branch.
OCTOCELL_HD bool same_bits(const Sphere& a, const Sphere& b) {
  std::uint64_t x[2];
  std::uint64_t y[2];
  memcpy(x, &a, sizeof a);
  memcpy(y, &b, sizeof b);
  return ((x[0] ^ y[0]) | (x[1] ^ y[1])) == 0;
}

}  // namespace octocell
