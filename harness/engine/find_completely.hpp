// SPDX-License-Identifier: MIT
// From a finder and a scene to a complete answer, however small the first buffers were.
#pragma once

#include <span>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"

namespace octocell {

struct Outcome {
  Plan plan;  // the one that was large enough
  Counts counts;
  StageTimes times;      // of the last run
  double plan_ms = 0.0;  // statistics and choices
  int runs = 0;          // 1 unless a buffer had to grow
};

/// The plan for a finder: of our own backends after a look at the scene, of a baseline at once.
Plan plan_scene(SceneView scene, const PlanOptions& options);

/// Plans, uploads, finds, and repeats with larger buffers until everything fits. The finder then
/// holds the answer, unless counts.over_candidate_limit says that it was not looked for.
/// Throws InputError for an invalid sphere, LimitError where the rule does not hold for the scene.
Outcome find_completely(PairFinder& finder, SceneView scene, const PlanOptions& options);

/// The same from a plan that stands; plan_ms is zero.
Outcome complete(PairFinder& finder, SceneView scene, Plan plan, StageClock& clock);

/// The pairs of a complete answer, sorted, as long as the finder keeps them. Throws LimitError
/// where they lie on a device and there is no memory for a copy.
std::span<const Pair> fetch_pairs(PairFinder& finder, const Outcome& outcome);

}  // namespace octocell
