// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace octocell::baselines {

/// What a quadratic broad phase compares, whatever the scene.
constexpr std::uint64_t all_pairs(std::uint64_t count) {
  return count == 0 ? 0 : count * (count - 1) / 2;
}

}  // namespace octocell::baselines
