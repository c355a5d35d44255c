// SPDX-License-Identifier: MIT
// The broad phases of other libraries, one for each class and tuning: their list, for the registry,
// and the functions that make them.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/finder.hpp"

namespace octocell::baselines {

struct Baseline {
  std::string_view name;  // library, class, tuning
  std::string_view summary;
  std::unique_ptr<PairFinder> (*create)();
  /// Why its answers can lack pairs although it is used correctly; empty if they cannot.
  std::string_view known_issues = {};
};

/// Returns all baselines in the order of tables; none in a build without FCL and Bullet.
std::span<const Baseline> all();

// FCL 0.7: tree_init_level 0 is its default (median split), 1 builds from Morton codes.
std::unique_ptr<PairFinder> make_fcl_dynamic_aabb_tree();
std::unique_ptr<PairFinder> make_fcl_dynamic_aabb_tree_morton();
std::unique_ptr<PairFinder> make_fcl_dynamic_aabb_tree_array();
std::unique_ptr<PairFinder> make_fcl_dynamic_aabb_tree_array_morton();

// FCL's other managers. Some lose pairs of boxes that only touch (README.md).
std::unique_ptr<PairFinder> make_fcl_sap();
std::unique_ptr<PairFinder> make_fcl_ssap();
std::unique_ptr<PairFinder> make_fcl_interval_tree();
std::unique_ptr<PairFinder> make_fcl_spatial_hashing();
std::unique_ptr<PairFinder> make_fcl_naive();
/// Makes it with cells that begin where the scene's box begins. It is in no table; it only shows
/// what that loses.
std::unique_ptr<PairFinder> make_fcl_spatial_hashing_aligned();

// Bullet 3.24: pairs are found on insertion (default), or in one tree-tree pass (m_deferedcollide).
std::unique_ptr<PairFinder> make_bullet_dbvt_broadphase();
std::unique_ptr<PairFinder> make_bullet_dbvt_broadphase_deferred();
std::unique_ptr<PairFinder> make_bullet_dbvt();

std::unique_ptr<PairFinder> make_bullet_axis_sweep();
std::unique_ptr<PairFinder> make_bullet_axis_sweep_32();
std::unique_ptr<PairFinder> make_bullet_simple();

/// Return the versions of the linked libraries, such as "0.7.0" and "3.24".
std::string fcl_version();
std::string bullet_version();

}  // namespace octocell::baselines
