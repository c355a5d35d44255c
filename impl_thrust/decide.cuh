// SPDX-License-Identifier: MIT
#pragma once

#include "core/overlap.hpp"
#include "core/pair.hpp"

namespace octocell::on_thrust {

/// Not inlined: CUDA's algorithms unroll their loops, and this is long (minutes of nvcc).
__attribute__((noinline)) OCTOCELL_HD bool overlap(const Sphere& a, const Sphere& b) {
  return overlap_exact(a, b);
}

/// Decides an uncertain pair.
struct Overlaps {
  const Sphere* spheres;
  OCTOCELL_HD bool operator()(Pair pair) const { return overlap(spheres[pair.i], spheres[pair.j]); }
};

}  // namespace octocell::on_thrust
