// SPDX-License-Identifier: MIT
#pragma once

#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {

/// Not inlined: it is long and rarely called, and would cost its callers registers (and nvcc
/// minutes).
__device__ __noinline__ static bool overlap(const Sphere* spheres, Pair pair) {
  return overlap_exact(load_sphere(spheres, pair.i), load_sphere(spheres, pair.j));
}

}  // namespace octocell::cuda_custom
