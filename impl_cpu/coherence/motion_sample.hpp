// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "harness/interface/sphere.hpp"
#include "harness/planner/skin_width.hpp"

namespace octocell::cpu::coherence {

class MotionSample {
 public:
  /// Forgets what it saw; the next scenes have so many spheres.
  void reset(std::uint64_t sphere_count);
  /// Compares with the frame before. None for the first.
  std::optional<FrameMotion> observe(SceneView scene);

 private:
  std::vector<std::uint32_t> chosen_;
  std::vector<Sphere> before_;
  bool has_seen_ = false;
};

}  // namespace octocell::cpu::coherence
