// SPDX-License-Identifier: MIT
// FCL's DynamicAABBTreeCollisionManager: a binary tree of boxes; each node is allocated separately.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include <memory>

#include "baselines/baselines.hpp"
#include "baselines/fcl/fcl_tree_finder.hpp"

namespace octocell::baselines {

using DynamicAabbTree = FclTreeFinder<fcl::DynamicAABBTreeCollisionManagerd>;

std::unique_ptr<PairFinder> make_fcl_dynamic_aabb_tree() {
  return std::make_unique<DynamicAabbTree>(FclTreeInit::median_split);
}

std::unique_ptr<PairFinder> make_fcl_dynamic_aabb_tree_morton() {
  return std::make_unique<DynamicAabbTree>(FclTreeInit::morton);
}

}  // namespace octocell::baselines
