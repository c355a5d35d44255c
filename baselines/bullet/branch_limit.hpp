// SPDX-License-Identifier: MIT
// A btDbvt is not balanced. Spheres inserted in order along a line, or all at one place, make one
// branch that is as long as there are spheres. Freeing it recurses once per level and would crash
// the process.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <cstddef>

namespace octocell::baselines {

inline constexpr int kMaxLevels = 1 << 16;  // 2 MiB of stack with the packaged library
inline constexpr std::size_t kInsertionsPerCheck = 1024;
inline constexpr const char* kBranchTooLong =
    "btDbvt degenerates on this scene: a branch of more than 65536 levels";

/// Checks the branch of a leaf after every 1024th insertion; must be called after each. That is
/// enough because a branch grows by one level per insertion.
inline bool branch_too_long(const btDbvtNode* leaf, std::size_t count) {
  if (count % kInsertionsPerCheck != 0) return false;
  int levels = 0;
  while (leaf->parent != nullptr && levels <= kMaxLevels) {
    leaf = leaf->parent;
    ++levels;
  }
  return levels > kMaxLevels;
}

}  // namespace octocell::baselines
