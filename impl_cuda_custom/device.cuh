// SPDX-License-Identifier: MIT
// What kernels of several stages need: loads, atomics, sums over a warp and a block.
#pragma once

#include <cstdint>

#include "impl_cuda_custom/radix_sort/device_tools.cuh"
#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom {

inline constexpr int kBlockWarps = kBlockThreads / kWarpThreads;

__device__ inline int lane() { return static_cast<int>(threadIdx.x) % kWarpThreads; }
__device__ inline int warp() { return static_cast<int>(threadIdx.x) / kWarpThreads; }
__device__ inline unsigned lanes_below() { return (1U << lane()) - 1U; }

/// Loads 16 bytes at once; device arrays are aligned for that.
__device__ inline Sphere load_sphere(const Sphere* spheres, std::uint64_t i) {
  const float4 s = __ldg(reinterpret_cast<const float4*>(spheres) + i);
  return {s.x, s.y, s.z, s.w};
}

__device__ inline void store_sphere(Sphere* spheres, std::uint64_t i, const Sphere& s) {
  reinterpret_cast<float4*>(spheres)[i] = {s.x, s.y, s.z, s.r};
}

/// Adds to *sum. Returns the value before.
__device__ inline std::uint64_t atomic_add(std::uint64_t* sum, std::uint64_t value) {
  static_assert(sizeof(std::uint64_t) == sizeof(unsigned long long));
  return atomicAdd(reinterpret_cast<unsigned long long*>(sum), value);
}

/// Returns the sum of the values of this lane and the lanes below it.
__device__ inline std::uint64_t sum_up_to_lane(std::uint64_t value) {
  for (int distance = 1; distance < kWarpThreads; distance *= 2) {
    const std::uint64_t below = __shfl_up_sync(kAllLanes, value, distance);
    if (lane() >= distance) value += below;
  }
  return value;
}

/// Returns the sum of all lanes' values in lane 0.
__device__ inline std::uint64_t sum_over_warp(std::uint64_t value) {
  for (int distance = kWarpThreads / 2; distance > 0; distance /= 2) {
    value += __shfl_down_sync(kAllLanes, value, distance);
  }
  return value;
}

/// Returns the largest of all lanes' values in every lane.
__device__ inline std::uint32_t max_over_warp(std::uint32_t value) {
#if __CUDA_ARCH__ >= 800
  return __reduce_max_sync(kAllLanes, value);
#else
  for (int distance = kWarpThreads / 2; distance > 0; distance /= 2) {
    value = max(value, __shfl_xor_sync(kAllLanes, value, distance));
  }
  return value;
#endif
}

struct Scan {
  std::uint64_t before;  // the sum of the values of all threads below
  std::uint64_t total;   // of the block
};

/// Returns sums of the block's values. All threads of the block must call it.
__device__ inline Scan scan_over_block(std::uint64_t value) {
  __shared__ std::uint64_t warp_sums[kBlockWarps];
  const std::uint64_t up_to_here = sum_up_to_lane(value);
  if (lane() == kWarpThreads - 1) warp_sums[warp()] = up_to_here;
  __syncthreads();
  Scan scan = {up_to_here - value, 0};
  for (int w = 0; w < kBlockWarps; ++w) {
    if (w < warp()) scan.before += warp_sums[w];
    scan.total += warp_sums[w];
  }
  __syncthreads();  // the next call may overwrite warp_sums
  return scan;
}

/// Adds the values of all threads to *sum, with one atomic. All threads of the block must call it.
__device__ inline void add_over_block(std::uint64_t* sum, std::uint64_t value) {
  __shared__ std::uint64_t warp_sums[kBlockWarps];
  const std::uint64_t of_warp = sum_over_warp(value);
  if (lane() == 0) warp_sums[warp()] = of_warp;
  __syncthreads();
  if (threadIdx.x == 0) {
    std::uint64_t of_block = 0;
    for (const std::uint64_t of_one : warp_sums) of_block += of_one;
    if (of_block != 0) atomic_add(sum, of_block);
  }
  __syncthreads();  // the next call may overwrite warp_sums
}

}  // namespace octocell::cuda_custom
