// SPDX-License-Identifier: MIT
#include "harness/engine/find_completely.hpp"

#include <memory>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "harness/engine/memory_guard.hpp"

namespace octocell {

Outcome complete(PairFinder& finder, SceneView scene, Plan plan, StageClock& clock) {
  Outcome outcome;
  const HostBytes bytes = finder.host_bytes(plan, scene);
  plan = within_memory(plan, bytes);
  for (;;) {
    finder.upload(plan, scene);
    finder.find_pairs(clock);
    outcome.times = clock.stop();
    outcome.counts = finder.counts();
    ++outcome.runs;
    if (outcome.counts.plan_violation) throw LimitError(*outcome.counts.plan_violation);
    const bool enough = fits(outcome.counts, plan.capacity, plan.count_only);
    if (enough || outcome.counts.over_candidate_limit) break;
    plan = grow_within_memory(plan, bytes, outcome.counts);
  }
  outcome.plan = plan;
  return outcome;
}

Plan plan_scene(SceneView scene, const PlanOptions& options) {
  if (options.buffers_only) {
    require_all_flags(scene);
    return plan_buffers(scene.spheres.size(), options);
  }
  return make_plan(measure(scene), options);
}

Outcome find_completely(PairFinder& finder, SceneView scene, const PlanOptions& options) {
  HostClock planning(Marks::off);
  planning.start();
  const Plan plan = plan_scene(scene, options);
  const double plan_ms = planning.stop().total_ms;

  const std::unique_ptr<StageClock> clock = finder.make_clock(Marks::on);
  Outcome outcome = complete(finder, scene, plan, *clock);
  outcome.plan_ms = plan_ms;
  return outcome;
}

std::span<const Pair> fetch_pairs(PairFinder& finder, const Outcome& outcome) {
  const bool copies = finder.host_bytes(outcome.plan, {}).per_pair == 0.0;
  if (copies) {
    require_memory(sizeof(Pair) * static_cast<double>(outcome.counts.pairs), "a copy of the pairs");
  }
  return finder.sorted_pairs();
}

}  // namespace octocell
