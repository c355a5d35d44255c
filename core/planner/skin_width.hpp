// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace octocell {

/// How a few spheres that may move have moved since the last frame. A guess at what all did, which
/// decides only what is worth trying, never what is true.
struct FrameMotion {
  float still_share = 0.0F;  // of the sample: equal bit for bit
  float farthest = 0.0F;     // that one of it moved; infinite where a radius changed
};

/// What a skin costs a backend, in times of a search. The defaults are impl_cpu's
/// (docs/decisions/0016-frame-coherence.md).
struct SkinCosts {
  float list = 1.6F;            // the search of grown spheres, and the list
  float fetch = 0.15F;          // each frame: every sphere fetched and compared
  float compare = 0.07F;        // each frame: the same for static ones
  float neighbor_list = 0.12F;  // each frame: the neighbor pairs of ungrown spheres
};

/// How wide a skin pays, if any does. A wide one lasts for many frames, each of which tests many
/// neighbor pairs; a narrow one is soon left. Only time depends on what it says.
class SkinWidth {
 public:
  /// `most`: the most that a radius may grow by. Static spheres do not.
  void reset(float most, const SkinCosts& costs = {}, float static_share = 0.0F);

  /// By how much to grow each radius now, for spheres that move like that. A pause is a frame
  /// shorter then.
  std::optional<float> half_skin_for(const FrameMotion& motion);
  /// Whether it would say that some growth pays.
  [[nodiscard]] bool pays_for(const FrameMotion& motion) const {
    return pause_ == 0 && best_for(motion);
  }

  /// A list was made with it, has served a frame, or has been left (or was too long).
  void made(float half_skin, const FrameMotion& motion);
  void served() { ++frames_served_; }
  void left();

 private:
  [[nodiscard]] std::optional<float> best_for(const FrameMotion& motion) const;
  [[nodiscard]] float cost_a_frame(float growth, float frames) const;

  SkinCosts costs_;
  float most_ = 0.0F;
  float static_share_ = 0.0F;
  float half_skin_ = 0.0F;
  float step_then_ = 0.0F;
  int frames_served_ = 0;
  float drift_ = 1.0F;  // how fast skins were left, of the steps seen: random ones cancel out
  int pause_ = 0;
  int next_pause_ = 0;
};

}  // namespace octocell
