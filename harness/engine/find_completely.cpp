// SPDX-License-Identifier: MIT
#include "harness/engine/find_completely.hpp"

#include <memory>
#include <optional>
#include <utility>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "harness/engine/memory_guard.hpp"

namespace octocell {
namespace {

/// Returns the statistics that a plan needs; a baseline's plan needs none.
std::optional<SceneStats> stats_for(SceneView scene, const PlanOptions& options) {
  if (!options.buffers_only) return measure(scene);
  require_all_flags(scene);
  return std::nullopt;
}

Plan plan_for(SceneView scene, const std::optional<SceneStats>& stats, const PlanOptions& options) {
  return stats ? make_plan(*stats, options) : plan_buffers(scene.spheres.size(), options);
}

}  // namespace

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
  return plan_for(scene, stats_for(scene, options), options);
}

Outcome find_completely(PairFinder& finder, SceneView scene, const PlanOptions& options) {
  HostClock planning(Marks::off);
  planning.start();
  std::optional<SceneStats> stats = stats_for(scene, options);
  const Plan plan = plan_for(scene, stats, options);
  const double plan_ms = planning.stop().total_ms;

  const std::unique_ptr<StageClock> clock = finder.make_clock(Marks::on);
  Outcome outcome = complete(finder, scene, plan, *clock);
  outcome.stats = std::move(stats);
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
