// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace octocell {

/// How a small sample of the movable spheres has moved since the last frame. It is a guess at the
/// motion of all. It decides only what is worth trying, never what is true.
struct FrameMotion {
  float still_share = 0.0F;  // part of the sample that is equal bit for bit
  float farthest = 0.0F;     // the longest move in the sample; infinite if a radius changed
};

/// What a skin costs a backend, in units of the time of a search. The defaults are those of
/// impl_cpu (docs/decisions/0016-frame-coherence.md).
struct SkinCosts {
  float list = 1.6F;            // a search of enlarged spheres, with writing the list
  float fetch = 0.15F;          // each frame: to fetch and compare every sphere
  float compare = 0.07F;        // each frame: the same for static spheres
  float neighbor_list = 0.12F;  // each frame: to test the neighbor pairs without growth
};

/// Decides whether a skin pays, and how wide it should be. A wide one lasts for many frames, but
/// each of them tests many neighbor pairs; a narrow one is soon used up. Its answer affects only
/// time.
class SkinWidth {
 public:
  /// `most`: the most by which a radius may grow. Static spheres do not grow.
  void reset(float most, const SkinCosts& costs = {}, float static_share = 0.0F);

  /// Returns by how much to enlarge each radius now, for spheres that move like that; none if no
  /// skin pays. During a pause, counts down one frame.
  std::optional<float> half_skin_for(const FrameMotion& motion);
  /// Returns true if half_skin_for() would say that some growth pays.
  [[nodiscard]] bool pays_for(const FrameMotion& motion) const {
    return pause_ == 0 && best_for(motion);
  }

  /// Notes that a list was made with it, has served a frame, or was given up (or was too long).
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
  float drift_ = 1.0F;  // how fast skins were used up, in steps as sampled: random steps cancel out
  int pause_ = 0;
  int next_pause_ = 0;
};

}  // namespace octocell
