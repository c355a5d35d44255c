// SPDX-License-Identifier: MIT
// What the parts of Images share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "harness/engine/images/image_scene.hpp"

namespace octocell::images {

inline constexpr double kUnit = 0x1p-53;          // U, half a unit in the last place of 1
inline constexpr double kMostBoxes = 0x1p29;      // so that a sum of three shifts is an int32
inline constexpr std::uint64_t kBlock = 1 << 13;  // spheres

inline void widen(Range& range, double lowest, double highest) {
  range.lowest = std::min(range.lowest, lowest);
  range.highest = std::max(range.highest, highest);
}
inline constexpr Range kNothing = {std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity()};

inline std::int32_t component(const Shift& s, int a) { return a == 0 ? s.a : a == 1 ? s.b : s.c; }

/// Calls visit(T) for all T of the steps whose first component that is not zero is positive.
template <typename Visit>
void for_positive(const Images::Steps& steps, const Visit& visit) {
  for (std::int32_t a = 0; a <= steps.last[0]; ++a) {
    for (std::int32_t b = a > 0 ? steps.first[1] : 0; b <= steps.last[1]; ++b) {
      const bool all = a > 0 || b > 0;
      for (std::int32_t c = all ? steps.first[2] : 1; c <= steps.last[2]; ++c) visit({a, b, c});
    }
  }
}

inline double count_positive(const Images::Steps& s) {
  const auto width = [&](int a) { return static_cast<double>(s.last[a] - s.first[a]) + 1.0; };
  return s.last[0] * width(1) * width(2) + s.last[1] * width(2) + s.last[2];
}

}  // namespace octocell::images
