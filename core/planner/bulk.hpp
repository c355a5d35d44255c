// SPDX-License-Identifier: MIT
// Where are nearly all spheres?  A grid may be laid over any box: what lies outside belongs to its
// border cells (docs/exactness.md, "The grid"). So a few spheres that are far away do not have to
// determine the cells of all others.
#pragma once

#include <vector>

#include "core/planner/scene_stats.hpp"

namespace octocell {

/// Returns boxes that, according to the sample, hold nearly all centres and are far smaller than
/// the box of all; the widest first. Most scenes have none, which a look at a few spheres shows.
std::vector<Bulk> find_bulk(const PlanFacts& facts, const std::vector<Sphere>& sample);

/// Returns the scene as if no centre were outside that box. Use it only to plan cells.
SceneStats only_bulk(SceneStats stats, const Bulk& bulk);

/// Returns the part of an axis, where nearly all spheres are, that a box of that width covers.
double share_of_axis(const SceneStats& stats, int axis, double width);

}  // namespace octocell
