// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/planner/skin_width.hpp"
#include "core/sphere.hpp"

namespace octocell::cpu::coherence {

class MotionSample {
 public:
  /// Forgets all earlier frames. The next scenes have as many spheres as this one. Spheres that are
  /// static now are not sampled, unless all are.
  void reset(SceneView scene);
  /// Compares with the last frame. Returns none for the first.
  std::optional<FrameMotion> observe(SceneView scene);

 private:
  std::vector<std::uint32_t> chosen_;
  std::vector<Sphere> before_;
  bool has_seen_ = false;
};

}  // namespace octocell::cpu::coherence
