// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "impl_cpu/coherence/motion_sample.hpp"

namespace octocell::cpu::coherence {

/// How wide a skin pays, if any does. A wide one lasts for many frames, each of which tests many
/// near pairs; a narrow one is soon left. Only time depends on what it says.
class SkinWidth {
 public:
  /// `most`: the most that a radius may grow by.
  void reset(float most);

  /// By how much to grow each radius now, for spheres that move like that.
  std::optional<float> half_skin_for(const Motion& motion);

  /// A list was made with it, has served a frame, or has been left (or was too long).
  void made(float half_skin, const Motion& motion);
  void served() { ++frames_served_; }
  void left();

 private:
  [[nodiscard]] static float cost_a_frame(float growth, float frames);

  float most_ = 0.0F;
  float half_skin_ = 0.0F;
  float step_then_ = 0.0F;
  int frames_served_ = 0;
  float drift_ = 1.0F;  // how fast skins were left, of the steps seen: random ones cancel out
  int pause_ = 0;
  int next_pause_ = 0;
};

}  // namespace octocell::cpu::coherence
