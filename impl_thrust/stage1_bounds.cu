// SPDX-License-Identifier: MIT
// Stage 1, bounds: are the plan's assumptions about the scene still true?
// Reads spheres. Writes a violation, or nothing.
// Cost: one pass, 16 bytes a sphere.
// Idea: one transform_reduce, from each sphere to what is wrong with it, to what is wrong with any.
#include <thrust/functional.h>
#include <thrust/transform_reduce.h>

#include <cstdint>

#include "core/flags.hpp"
#include "core/plan_facts.hpp"
#include "core/planner/scene_stats.hpp"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {
namespace {

struct Violations {
  PlanFacts facts;
  OCTOCELL_HD std::uint32_t operator()(const Sphere& s) const { return violation_of(s, facts); }
};

/// Leaves the results that the stages would have left if they ran.
template <typename System>
void leave_nothing(Workspace<System>& w) {
  w.id_count = w.cell_count = 0;
  w.sure_count = w.pair_count = w.uncertain_count = w.checksum = 0;
  if (some_may_collide(w.scene.flags)) w.violation = kFlagsBroken;
}

}  // namespace

template <typename System>
void bounds(Workspace<System>& w) {
  w.violation.reset();
  w.candidates = 0;
  w.used = {};
  if (w.plan.nothing_to_find) leave_nothing(w);
  if (w.sphere_count() == 0) return;
  const std::uint32_t violations = thrust::transform_reduce(
      w.system.policy(), w.spheres, w.spheres + w.sphere_count(), Violations{w.plan.facts},
      std::uint32_t{0}, thrust::bit_or<std::uint32_t>{});
  if ((violations & kInvalidSphere) != 0) {
    w.violation = describe_first_invalid(w.scene.spheres);
  } else if (violations != 0 || w.sphere_count() != w.plan.facts.sphere_count) {
    w.violation = kFactsBroken;
  }
}

OCTOCELL_FOR_BOTH_SYSTEMS(bounds);

}  // namespace octocell::on_thrust
