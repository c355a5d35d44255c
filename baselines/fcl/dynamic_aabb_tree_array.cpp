// SPDX-License-Identifier: MIT
// FCL's DynamicAABBTreeCollisionManager_Array: the same tree with its nodes in one array.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>

#include <memory>

#include "baselines/baselines.hpp"
#include "baselines/fcl/fcl_tree_finder.hpp"

#ifdef __SANITIZE_ADDRESS__
// registerObjects() of FCL 0.7 never frees the leaves that it copies into the tree (README.md).
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfcl\n"; }
#endif

namespace octocell::baselines {

using DynamicAabbTreeArray = FclTreeFinder<fcl::DynamicAABBTreeCollisionManager_Arrayd>;

std::unique_ptr<PairFinder> make_fcl_dynamic_aabb_tree_array() {
  return std::make_unique<DynamicAabbTreeArray>(FclTreeInit::median_split);
}

std::unique_ptr<PairFinder> make_fcl_dynamic_aabb_tree_array_morton() {
  return std::make_unique<DynamicAabbTreeArray>(FclTreeInit::morton);
}

}  // namespace octocell::baselines
