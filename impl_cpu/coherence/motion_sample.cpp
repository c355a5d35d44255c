// SPDX-License-Identifier: MIT
#include "impl_cpu/coherence/motion_sample.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/flags.hpp"
#include "core/pair.hpp"

namespace octocell::cpu::coherence {
namespace {

constexpr std::uint64_t kSampled = 256;

float distance_moved(const Sphere& before, const Sphere& now) {
  if (std::bit_cast<std::uint32_t>(before.r) != std::bit_cast<std::uint32_t>(now.r)) {
    return std::numeric_limits<float>::infinity();
  }
  return std::hypot(now.x - before.x, now.y - before.y, now.z - before.z);
}

}  // namespace

void MotionSample::reset(SceneView scene) {
  const std::vector<std::uint32_t> movable = movable_among(scene.flags);
  const std::uint64_t count = movable.empty() ? scene.spheres.size() : movable.size();
  has_seen_ = false;
  chosen_.resize(std::min(count, kSampled));
  before_.resize(chosen_.size());
  for (std::uint32_t k = 0; k < chosen_.size(); ++k) {
    const std::uint64_t n = mix_pair({0, k}) % count;
    chosen_[k] = movable.empty() ? static_cast<std::uint32_t>(n) : movable[n];
  }
}

std::optional<FrameMotion> MotionSample::observe(SceneView scene) {
  FrameMotion motion;
  std::size_t still = 0;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const Sphere& now = scene.spheres[chosen_[k]];
    if (std::memcmp(&now, &before_[k], sizeof now) == 0) ++still;
    motion.farthest = std::max(motion.farthest, distance_moved(before_[k], now));
    before_[k] = now;
  }
  const bool has_seen = has_seen_;
  has_seen_ = true;
  if (!has_seen || chosen_.empty()) return std::nullopt;
  motion.still_share = static_cast<float>(still) / static_cast<float>(chosen_.size());
  return motion;
}

}  // namespace octocell::cpu::coherence
