// SPDX-License-Identifier: MIT
// Stage 1, bounds: are the plan's assumptions about the scene still true?
// Reads spheres. Writes a violation, or nothing.
// Cost: one pass, 16 bytes a sphere.
// Idea: one transform_reduce, from spheres to the extremes that the plan's proofs rest on.
#include <thrust/logical.h>
#include <thrust/transform_reduce.h>

#include <cmath>
#include <limits>

#include "core/flags.hpp"
#include "core/lattice.hpp"
#include "core/planner/scene_stats.hpp"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Extremes {
  float lowest[3] = {kInfinity, kInfinity, kInfinity};
  float highest[3] = {-kInfinity, -kInfinity, -kInfinity};
  float r_max = 0.0F;
  float r_min = kInfinity;
  float r_min_nonzero = kInfinity;
  bool valid = true;
};

OCTOCELL_HD float smaller(float a, float b) { return b < a ? b : a; }
OCTOCELL_HD float larger(float a, float b) { return b > a ? b : a; }
OCTOCELL_HD bool is_finite(float value) { return value - value == 0.0F; }

struct ExtremesOfOne {
  OCTOCELL_HD Extremes operator()(const Sphere& s) const {
    Extremes e = {{s.x, s.y, s.z}, {s.x, s.y, s.z}, s.r, s.r, s.r > 0.0F ? s.r : kInfinity, true};
    e.valid = is_finite(s.x) && is_finite(s.y) && is_finite(s.z) && is_finite(s.r) && s.r >= 0.0F;
    return e;
  }
};

struct ExtremesOfBoth {
  OCTOCELL_HD Extremes operator()(const Extremes& a, const Extremes& b) const {
    Extremes both;
    for (int axis = 0; axis < 3; ++axis) {
      both.lowest[axis] = smaller(a.lowest[axis], b.lowest[axis]);
      both.highest[axis] = larger(a.highest[axis], b.highest[axis]);
    }
    both.r_max = larger(a.r_max, b.r_max);
    both.r_min = smaller(a.r_min, b.r_min);
    both.r_min_nonzero = smaller(a.r_min_nonzero, b.r_min_nonzero);
    both.valid = a.valid && b.valid;
    return both;
  }
};

bool within(const Extremes& seen, const PlanFacts& planned) {
  bool inside = seen.r_max <= planned.r_max;
  for (int a = 0; a < 3; ++a) {
    inside = inside && seen.lowest[a] >= planned.lowest[a] && seen.highest[a] <= planned.highest[a];
  }
  return inside && seen.r_min >= planned.r_min && seen.r_min_nonzero >= planned.r_min_nonzero;
}

struct OnLattice {
  double units_per_length;
  OCTOCELL_HD bool operator()(const Sphere& s) const {
    return lies_on_lattice(s, units_per_length);
  }
};

template <typename System>
bool on_planned_lattice(Workspace<System>& w) {
  const double lattice = w.plan.facts.lattice_units_per_length;
  if (lattice == 0.0) return true;
  return thrust::all_of(w.system.policy(), w.spheres, w.spheres + w.sphere_count(),
                        OnLattice{lattice});
}

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
  const Extremes seen =
      thrust::transform_reduce(w.system.policy(), w.spheres, w.spheres + w.sphere_count(),
                               ExtremesOfOne{}, Extremes{}, ExtremesOfBoth{});
  if (!seen.valid) {
    w.violation = describe_first_invalid(w.scene.spheres);
  } else if (w.sphere_count() != w.plan.facts.sphere_count || !within(seen, w.plan.facts) ||
             !on_planned_lattice(w)) {
    w.violation = kFactsBroken;
  }
}

OCTOCELL_FOR_BOTH_SYSTEMS(bounds);

}  // namespace octocell::on_thrust
