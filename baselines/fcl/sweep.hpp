// SPDX-License-Identifier: MIT
// How many pairs FCL's sweeps compare: all pairs whose intervals meet along one axis.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "baselines/all_pairs.hpp"
#include "core/sphere.hpp"

namespace octocell::baselines {

/// The ends of all boxes along one axis; each list is sorted. [2][sphere]
struct SweepAxis {
  std::vector<double> lows;
  std::vector<double> highs;

  SweepAxis(std::span<const Sphere> spheres, float Sphere::*coordinate) {
    lows.reserve(spheres.size());
    highs.reserve(spheres.size());
    for (const Sphere& s : spheres) {
      const double centre = s.*coordinate;
      lows.push_back(centre - s.r);
      highs.push_back(centre + s.r);
    }
    std::sort(lows.begin(), lows.end());
    std::sort(highs.begin(), highs.end());
  }

  [[nodiscard]] double extent() const { return lows.empty() ? 0.0 : highs.back() - lows.front(); }

  /// Counts pairs of intervals that meet. Of two that meet, each begins before the other ends; of
  /// two that do not, only one does.
  [[nodiscard]] std::uint64_t meeting_pairs() const {
    std::uint64_t begun = 0;
    std::uint64_t begun_before_ends = 0;
    for (const double high : highs) {
      while (begun < lows.size() && lows[begun] <= high) ++begun;
      begun_before_ends += begun;
    }
    return begun_before_ends - lows.size() - all_pairs(lows.size());
  }
};

enum class SweepAlong : bool { longest, shortest };

/// Returns how many pairs a sweep compares along the longest or shortest side of the scene's box.
inline std::uint64_t sweep_pairs(std::span<const Sphere> spheres, SweepAlong along) {
  const std::array<SweepAxis, 3> axes = {SweepAxis(spheres, &Sphere::x),
                                         SweepAxis(spheres, &Sphere::y),
                                         SweepAxis(spheres, &Sphere::z)};
  const auto [shortest, longest] = std::ranges::minmax_element(axes, {}, &SweepAxis::extent);
  return (along == SweepAlong::longest ? longest : shortest)->meeting_pairs();
}

}  // namespace octocell::baselines
