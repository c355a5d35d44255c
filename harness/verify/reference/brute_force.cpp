// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {

std::vector<Pair> brute_force(std::span<const Sphere> spheres, AllFlags flags) {
  std::vector<Pair> pairs;
  const auto count = static_cast<std::uint32_t>(spheres.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      if (!flags.empty() && !allowed(flags[i], flags[j])) continue;
      if (overlap(spheres[i], spheres[j])) pairs.push_back({i, j});
    }
  }
  return pairs;
}

std::vector<Pair> exact_pairs(std::span<const Sphere> spheres, AllFlags flags) {
  constexpr std::size_t kFewSpheres = 500;
  return spheres.size() <= kFewSpheres ? brute_force(spheres, flags) : box_tree(spheres, flags);
}

}  // namespace octocell::reference
