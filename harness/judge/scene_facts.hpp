// SPDX-License-Identifier: MIT
// What hypotheses about a scene's pairs need to know of the scene.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pair.hpp"
#include "core/sphere.hpp"

namespace octocell::judge {

constexpr std::array<float, 3> centre_of(const Sphere& s) { return {s.x, s.y, s.z}; }

struct SceneFacts {
  std::span<const Sphere> spheres;
  std::span<const Pair> truth;
  float r_max = 0.0F;
  std::array<float, 3> lowest = {};          // of the centres
  std::array<float, 3> highest = {};         // likewise
  std::array<float, 3> box_lowest = {};      // of p - r
  std::vector<std::uint32_t> partners = {};  // of each sphere: its true pairs

  SceneFacts(std::span<const Sphere> all, std::span<const Pair> pairs)
      : spheres(all), truth(pairs), partners(all.size()) {
    if (!all.empty()) lowest = highest = box_lowest = centre_of(all[0]);
    for (const Sphere& s : all) {
      r_max = std::max(r_max, s.r);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float p = centre_of(s)[axis];
        lowest[axis] = std::min(lowest[axis], p);
        highest[axis] = std::max(highest[axis], p);
        box_lowest[axis] = std::min(box_lowest[axis], p - s.r);
      }
    }
    for (const Pair& pair : pairs) {
      ++partners[pair.i];
      ++partners[pair.j];
    }
  }
};

}  // namespace octocell::judge
