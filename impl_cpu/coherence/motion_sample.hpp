// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "harness/interface/sphere.hpp"

namespace octocell::cpu::coherence {

/// How a few spheres have moved since the last frame. A guess at what all did, which decides only
/// what is worth trying, never what is true.
struct Motion {
  float still_share = 0.0F;  // of the sample: equal bit for bit
  float farthest = 0.0F;     // that one of it moved; infinite where a radius changed
};

class MotionSample {
 public:
  /// Forgets what it saw; the next scenes have so many spheres.
  void reset(std::uint64_t sphere_count);
  /// Compares with the frame before. None for the first.
  std::optional<Motion> observe(SceneView scene);

 private:
  std::vector<std::uint32_t> chosen_;
  std::vector<Sphere> before_;
  bool has_seen_ = false;
};

}  // namespace octocell::cpu::coherence
