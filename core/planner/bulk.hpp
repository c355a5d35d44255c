// SPDX-License-Identifier: MIT
// Where are nearly all spheres?  A grid may be laid over any box: what lies outside belongs to its
// border cells (docs/exactness.md, "The grid"). So a few spheres that are far away need not dictate
// the cells of all others.
#pragma once

#include <vector>

#include "core/planner/scene_stats.hpp"

namespace octocell {

/// Boxes that hold nearly all centres and are far smaller than the box of all, as the sample tells;
/// from the widest. None for most scenes, which a glance at a few spheres shows.
std::vector<Bulk> find_bulk(const PlanFacts& facts, const std::vector<Sphere>& sample);

/// The same scene, as if there were no centres outside that box. Only cells may be planned for it.
SceneStats only_bulk(SceneStats stats, const Bulk& bulk);

/// The part of an axis that a box of that width covers, where nearly all spheres are.
double share_of_axis(const SceneStats& stats, int axis, double width);

}  // namespace octocell
