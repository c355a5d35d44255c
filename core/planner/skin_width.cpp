// SPDX-License-Identifier: MIT
#include "core/planner/skin_width.hpp"

#include <algorithm>
#include <cmath>

#include "core/plan.hpp"

namespace octocell {
namespace {

constexpr float kWorthwhile = 0.9F;  // part of the time of a search
constexpr int kWidths = 8;           // widths that are tried, up to the widest
constexpr int kFewFrames = 2;        // a list that served fewer frames was a mistake
constexpr int kFirstPause = 4;       // in frames; doubled after each further mistake
constexpr int kLongestPause = 1024;

float cube(float x) { return x * x * x; }

}  // namespace

void SkinWidth::reset(float most, const SkinCosts& costs, float static_share) {
  *this = {};
  costs_ = costs;
  most_ = most;
  static_share_ = static_share;
  next_pause_ = kFirstPause;
}

/// Returns the cost of a frame with a skin. `growth` is in mean radii. As in a gas, the number of
/// neighbor pairs grows as the cube of the mean growth of two spheres.
float SkinWidth::cost_a_frame(float growth, float frames) const {
  const float moving = 1.0F - static_share_;
  const float near = moving * moving * cube(1.0F + growth) +
                     2.0F * moving * static_share_ * cube(1.0F + growth / 2.0F);
  const float served =
      moving * costs_.fetch + static_share_ * costs_.compare + costs_.neighbor_list * near;
  return (costs_.list + (frames - 1.0F) * served) / frames;
}

std::optional<float> SkinWidth::half_skin_for(const FrameMotion& motion) {
  if (pause_ > 0) {
    --pause_;
    return std::nullopt;
  }
  return best_for(motion);
}

std::optional<float> SkinWidth::best_for(const FrameMotion& motion) const {
  const float step = std::max(motion.farthest * drift_, most_ / 1024.0F);
  std::optional<float> best;
  float best_cost = kWorthwhile;
  for (int k = 1; k <= kWidths; ++k) {
    const float part = static_cast<float>(k) / kWidths;
    const float half_skin = most_ * part;
    const float frames = 1.0F + std::floor(half_skin / step);
    const float cost = cost_a_frame(most_skin(static_share_) * part, frames);
    if (!(cost < best_cost)) continue;
    best = half_skin;
    best_cost = cost;
  }
  return best;
}

void SkinWidth::made(float half_skin, const FrameMotion& motion) {
  half_skin_ = half_skin;
  step_then_ = motion.farthest;
  frames_served_ = 0;
}

void SkinWidth::left() {
  if (step_then_ > 0.0F) {
    const float step = half_skin_ / static_cast<float>(frames_served_ + 1);
    drift_ = std::clamp(step / step_then_, 0.1F, 2.0F);
  }
  if (frames_served_ >= kFewFrames) {
    next_pause_ = kFirstPause;
    return;
  }
  pause_ = next_pause_;
  next_pause_ = std::min(2 * next_pause_, kLongestPause);
}

}  // namespace octocell
