// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/lattice.hpp"
#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {

/// Returns the bits of State::violations for a sphere that breaks an assumption of the plan.
__device__ inline std::uint32_t violation_of(const Sphere& s, const PlanFacts& facts) {
  const bool finite = isfinite(s.x) && isfinite(s.y) && isfinite(s.z) && isfinite(s.r);
  if (!finite || s.r < 0.0F) return kInvalidSphere;
  bool inside = s.r <= facts.r_max && (s.r == 0.0F || s.r >= facts.r_min_nonzero);
  inside = inside && s.x >= facts.lowest[0] && s.x <= facts.highest[0];
  inside = inside && s.y >= facts.lowest[1] && s.y <= facts.highest[1];
  inside = inside && s.z >= facts.lowest[2] && s.z <= facts.highest[2];
  inside = inside && s.r >= facts.r_min;
  const double lattice = facts.lattice_units_per_length;  // the same for all threads, so all take
                                                          // the same branch
  inside = inside && (lattice == 0.0 || lies_on_lattice(s, lattice));
  return inside ? 0 : kOutsidePlan;
}

}  // namespace octocell::cuda_custom
