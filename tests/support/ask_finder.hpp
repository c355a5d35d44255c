// SPDX-License-Identifier: MIT
// Runs a finder with given buffers, for tests.
#pragma once

#include "core/finder.hpp"
#include "core/planner/planner.hpp"
#include "harness/engine/finder_answer.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {

inline FinderAnswer ask(PairFinder& finder, const Plan& plan, SceneView scene) {
  HostClock clock;
  finder.upload(plan, scene);
  finder.find_pairs(clock);
  return {finder.counts(), finder.digest(), finder.download()};
}

inline Plan roomy_plan(const Scene& scene, const PlanOptions& options) {
  Plan plan = make_plan(measure(scene.view()), options);
  plan.capacity.ids = plan.capacity.ids * 2 + 4096;
  plan.capacity.cells = plan.capacity.ids;
  plan.capacity.pairs = plan.capacity.uncertain_pairs = 40 * scene.spheres.size() + 64;
  return plan;
}

/// Repeats with larger buffers, like find_completely().
inline FinderAnswer ask_until_it_fits(PairFinder& finder, Plan plan, SceneView scene) {
  FinderAnswer answer = ask(finder, plan, scene);
  while (!fits(answer.counts, plan.capacity, plan.count_only)) {
    plan = grow(plan, answer.counts);
    answer = ask(finder, plan, scene);
  }
  return answer;
}

}  // namespace octocell
