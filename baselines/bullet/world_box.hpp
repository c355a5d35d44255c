// SPDX-License-Identifier: MIT
// The world that Bullet's axis sweeps divide into integer steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "baselines/bullet/bullet_box.hpp"

namespace octocell::baselines {

/// The box of all spheres, with an eighth of its size on each side to move in. Positions outside
/// are moved to its border. That loses no pair, because positions are rounded and clamped
/// monotonically.
class WorldBox {
 public:
  explicit WorldBox(std::span<const Sphere> spheres) {
    for (int k = 0; k < 3; ++k) {
      double low = 0.0;
      double high = 0.0;
      if (!spheres.empty()) {
        low = spheres.front().*kAxes[k];
        high = low;
      }
      for (const Sphere& s : spheres) {
        low = std::min(low, static_cast<double>(s.*kAxes[k]) - s.r);
        high = std::max(high, static_cast<double>(s.*kAxes[k]) + s.r);
      }
      widen(low, high);
      lowest_[k] = static_cast<float>(low);
      highest_[k] = static_cast<float>(high);
    }
  }

  [[nodiscard]] btVector3 lowest() const { return {lowest_[0], lowest_[1], lowest_[2]}; }
  [[nodiscard]] btVector3 highest() const { return {highest_[0], highest_[1], highest_[2]}; }

  [[nodiscard]] bool holds(const Sphere& s) const {
    for (int k = 0; k < 3; ++k) {
      if (s.*kAxes[k] - s.r < lowest_[k] || s.*kAxes[k] + s.r > highest_[k]) return false;
    }
    return true;
  }

 private:
  static constexpr float Sphere::*kAxes[3] = {&Sphere::x, &Sphere::y, &Sphere::z};

  // Bullet divides the number of steps by the width in float32. Neither may become infinite, and
  // the width must not vanish compared with the position.
  static void widen(double& low, double& high) {
    constexpr double kNarrowest = 0x1p-90;
    constexpr double kFarthest = 0x1.8p126;
    const double position = std::max(std::abs(low), std::abs(high));
    const double room = std::max({(high - low) / 8.0, position * 0x1p-20, kNarrowest});
    low = std::clamp(low - room, -kFarthest, kFarthest);
    high = std::clamp(high + room, -kFarthest, kFarthest);
    if (low == high) (low > 0.0 ? low : high) = 0.0;  // everything lies beyond the limit
  }

  float lowest_[3];
  float highest_[3];
};

}  // namespace octocell::baselines
