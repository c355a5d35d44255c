// SPDX-License-Identifier: MIT
// The list of all baselines.
#include <span>
#include <string_view>

#include "baselines/baselines.hpp"

namespace octocell::baselines {
namespace {

constexpr std::string_view kTouchingBoxesLost =
    "ends of boxes are sorted by position only, so boxes that just touch can be taken for apart";
constexpr std::string_view kHalfOpenCells =
    "cells lack their upper border, so boxes that touch there share no cell";

constexpr Baseline kAll[] = {
    {"fcl_dynamic_aabb_tree", "FCL DynamicAABBTree, default settings", make_fcl_dynamic_aabb_tree},
    {"fcl_dynamic_aabb_tree_morton", "FCL DynamicAABBTree, tree_init_level = 1",
     make_fcl_dynamic_aabb_tree_morton},
    {"fcl_dynamic_aabb_tree_array", "FCL DynamicAABBTree_Array, default settings",
     make_fcl_dynamic_aabb_tree_array},
    {"fcl_dynamic_aabb_tree_array_morton", "FCL DynamicAABBTree_Array, tree_init_level = 1",
     make_fcl_dynamic_aabb_tree_array_morton},
    {"fcl_sap", "FCL SaP: end points kept sorted, a list of pairs", make_fcl_sap,
     kTouchingBoxesLost},
    {"fcl_ssap", "FCL SSaP: sort and sweep at every query", make_fcl_ssap},
    {"fcl_interval_tree", "FCL IntervalTree: a sweep, and three trees", make_fcl_interval_tree,
     kTouchingBoxesLost},
    {"fcl_spatial_hashing", "FCL SpatialHashing, cells of two largest radii",
     make_fcl_spatial_hashing, kHalfOpenCells},
    {"fcl_naive", "FCL Naive: all pairs of boxes", make_fcl_naive},
    {"bullet_dbvt_broadphase", "Bullet btDbvtBroadphase, default settings",
     make_bullet_dbvt_broadphase},
    {"bullet_dbvt_broadphase_deferred", "Bullet btDbvtBroadphase, m_deferedcollide",
     make_bullet_dbvt_broadphase_deferred},
    {"bullet_dbvt", "Bullet's bare btDbvt tree, joined with itself", make_bullet_dbvt},
    {"bullet_axis_sweep", "Bullet btAxisSweep3, in 16 bits", make_bullet_axis_sweep},
    {"bullet_axis_sweep_32", "Bullet bt32BitAxisSweep3", make_bullet_axis_sweep_32},
    {"bullet_simple", "Bullet btSimpleBroadphase: all pairs of boxes", make_bullet_simple},
};

}  // namespace

std::span<const Baseline> all() { return kAll; }

}  // namespace octocell::baselines
