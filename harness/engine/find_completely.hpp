// SPDX-License-Identifier: MIT
// Runs a finder on a scene until its answer is complete, however small the first buffers were.
#pragma once

#include <optional>
#include <span>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"

namespace octocell {

struct Outcome {
  std::optional<SceneStats> stats;  // that the plan was made from, by find_completely() for one of
                                    // our backends
  Plan plan;                        // the last one, which was large enough
  Counts counts;
  StageTimes times;      // of the last run
  double plan_ms = 0.0;  // for statistics and choices
  int runs = 0;          // 1 unless a buffer had to grow
};

/// Returns the plan for a finder. For our own backends it depends on the scene; for a baseline it
/// does not.
Plan plan_scene(SceneView scene, const PlanOptions& options);

/// Plans, uploads and finds, and repeats with larger buffers until everything fits. Then the finder
/// holds the answer, unless counts.over_candidate_limit says that the search was not done. Throws
/// InputError for an invalid sphere, and LimitError if the rule does not hold for the scene.
Outcome find_completely(PairFinder& finder, SceneView scene, const PlanOptions& options);

/// Does the same with a given plan; plan_ms is zero.
Outcome complete(PairFinder& finder, SceneView scene, Plan plan, StageClock& clock);

/// Returns the pairs of a complete answer, sorted; valid as long as the finder keeps them. Throws
/// LimitError if they are on a device and there is no memory for a copy.
std::span<const Pair> fetch_pairs(PairFinder& finder, const Outcome& outcome);

}  // namespace octocell
