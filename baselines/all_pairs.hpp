// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace octocell::baselines {

/// Returns how many pairs a quadratic broad phase compares.
constexpr std::uint64_t all_pairs(std::uint64_t count) {
  return count == 0 ? 0 : count * (count - 1) / 2;
}

}  // namespace octocell::baselines
