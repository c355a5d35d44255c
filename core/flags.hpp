// SPDX-License-Identifier: MIT
// Which pairs count at all, wherever the two spheres are. Every implementation calls this code
// before it decides a pair; only the reference has its own version.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell {

OCTOCELL_HD bool is_static(Flags f) { return (f.word & 0x8000U) != 0; }
OCTOCELL_HD std::uint32_t group_of(Flags f) { return f.word & kMaxGroup; }
OCTOCELL_HD std::uint32_t mask_of(Flags f) { return f.word >> 16; }

/// Returns true unless both are static, if each is in a group that the other's mask names; as in
/// Bullet's collision filter (btOverlappingPairCache::needsBroadphaseCollision).
OCTOCELL_HD bool may_collide(Flags a, Flags b) {
  return !(is_static(a) && is_static(b)) && (group_of(a) & mask_of(b)) != 0 &&
         (group_of(b) & mask_of(a)) != 0;
}

inline std::uint64_t count_static(std::span<const Flags> flags) {
  return static_cast<std::uint64_t>(std::ranges::count_if(flags, is_static));
}

/// Returns the indices of the spheres that are not static.
inline std::vector<std::uint32_t> movable_among(std::span<const Flags> flags) {
  std::vector<std::uint32_t> movable;
  for (std::uint32_t k = 0; k < flags.size(); ++k) {
    if (!is_static(flags[k])) movable.push_back(k);
  }
  return movable;
}

/// Returns false only if no two spheres can collide, so that no search is needed. In a pair that
/// may collide, one sphere is not static; its group is in some mask, and its mask names some group.
inline bool some_may_collide(std::span<const Flags> flags) {
  if (flags.empty()) return true;
  std::uint32_t groups = 0;
  std::uint32_t masks = 0;
  std::uint32_t moving_groups = 0;
  std::uint32_t moving_masks = 0;
  for (const Flags f : flags) {
    const std::uint32_t if_moving = is_static(f) ? 0U : ~0U;
    groups |= group_of(f);
    masks |= mask_of(f);
    moving_groups |= group_of(f) & if_moving;
    moving_masks |= mask_of(f) & if_moving;
  }
  return (moving_groups & masks) != 0 && (moving_masks & groups) != 0;
}

}  // namespace octocell
