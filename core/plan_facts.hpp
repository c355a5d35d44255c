// SPDX-License-Identifier: MIT
// Stage 1's question: are the facts that a plan rests on still true?
#pragma once

#include <cstdint>

#include "core/host_device.hpp"
#include "core/lattice.hpp"
#include "core/plan.hpp"

namespace octocell {

/// What can be wrong with a sphere, as bits.
inline constexpr std::uint32_t kInvalidSphere = 1;  // not finite, or a negative radius
inline constexpr std::uint32_t kOutsidePlan = 2;    // beyond the plan's facts

/// Returns what is wrong with a sphere.
OCTOCELL_HD std::uint32_t violation_of(const Sphere& s, const PlanFacts& facts) {
  const auto is_finite = [](float value) { return value - value == 0.0F; };
  const bool finite = is_finite(s.x) && is_finite(s.y) && is_finite(s.z) && is_finite(s.r);
  if (!finite || s.r < 0.0F) return kInvalidSphere;
  bool inside = s.r <= facts.r_max && (s.r == 0.0F || s.r >= facts.r_min_nonzero);
  inside = inside && s.x >= facts.lowest[0] && s.x <= facts.highest[0];
  inside = inside && s.y >= facts.lowest[1] && s.y <= facts.highest[1];
  inside = inside && s.z >= facts.lowest[2] && s.z <= facts.highest[2];
  inside = inside && s.r >= facts.r_min;
  const double lattice = facts.lattice_units_per_length;  // the same for all spheres, so GPU
                                                          // threads take the same branch
  inside = inside && (lattice == 0.0 || lies_on_lattice(s, lattice));
  return inside ? 0 : kOutsidePlan;
}

/// Returns true if the facts of all spheres together are at least as strong as those of a plan. All
/// spheres are valid. Does not look at the lattice.
inline bool are_within(const PlanFacts& seen, const PlanFacts& planned) {
  bool inside = seen.sphere_count == planned.sphere_count && seen.r_max <= planned.r_max;
  for (int a = 0; a < 3; ++a) {
    inside = inside && seen.lowest[a] >= planned.lowest[a] && seen.highest[a] <= planned.highest[a];
  }
  const bool has_radius = seen.r_min_nonzero != 0.0F;
  inside = inside && (!has_radius || seen.r_min_nonzero >= planned.r_min_nonzero);
  return inside && seen.r_min >= planned.r_min;
}

}  // namespace octocell
