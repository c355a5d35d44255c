// SPDX-License-Identifier: MIT
// What the kernels of several variants share: sizes, sums over a warp and over a block.
#pragma once

#include <cstdint>

namespace octocell::cuda_custom {

constexpr int kWarpThreads = 32;
constexpr unsigned kAllLanes = 0xffffffffu;

/// Returns how many parts of `size` items cover `count` items (below 2^31).
__host__ __device__ constexpr std::uint32_t parts_of(std::uint32_t count, std::uint32_t size) {
  return (count + size - 1) / size;
}

/// Returns how many pairs there are to sort; only the device knows that number.
__device__ inline std::uint32_t pairs_to_sort(const std::uint64_t* count, std::uint32_t capacity) {
  const std::uint64_t wanted = *count;
  return wanted < capacity ? static_cast<std::uint32_t>(wanted) : capacity;
}

__device__ inline int lane_of_thread() { return threadIdx.x % kWarpThreads; }
__device__ inline int warp_of_thread() { return threadIdx.x / kWarpThreads; }

/// Makes the compiler compute values from x again instead of keeping them in registers. Without
/// this, the digits and ranks of a large tile do not fit into registers.
__device__ inline void forget(std::uint32_t& x) { asm volatile("" : "+r"(x)); }
template <int kSize>
__device__ void forget(std::uint32_t (&words)[kSize]) {
#pragma unroll
  for (int i = 0; i < kSize; ++i) forget(words[i]);
}

/// Returns the sum of x over this lane and all lanes below it.
__device__ inline std::uint32_t warp_inclusive_sum(std::uint32_t x) {
#pragma unroll
  for (int step = 1; step < kWarpThreads; step *= 2) {
    const std::uint32_t below = __shfl_up_sync(kAllLanes, x, step);
    if (lane_of_thread() >= step) x += below;
  }
  return x;
}

struct Sums {
  std::uint32_t before;  // x of all threads below this one
  std::uint32_t total;   // x of all threads
};

/// Returns sums over the block. All threads must call it. Two calls with the same `warp_sums` need
/// a __syncthreads() between them.
template <int kThreads>
__device__ Sums block_sums(std::uint32_t x, std::uint32_t (&warp_sums)[kThreads / kWarpThreads]) {
  constexpr int kWarps = kThreads / kWarpThreads;
  static_assert(kWarps <= kWarpThreads);
  const std::uint32_t inclusive = warp_inclusive_sum(x);
  if (lane_of_thread() == kWarpThreads - 1) warp_sums[warp_of_thread()] = inclusive;
  __syncthreads();
  // Every warp adds up the sums of all warps, which saves a second barrier.
  const int lane = lane_of_thread();
  const std::uint32_t sums = warp_inclusive_sum(lane < kWarps ? warp_sums[lane] : 0);
  const int warp = warp_of_thread();
  const std::uint32_t up_to_warp_below = __shfl_sync(kAllLanes, sums, warp == 0 ? 0 : warp - 1);
  const std::uint32_t total = __shfl_sync(kAllLanes, sums, kWarps - 1);
  return {(warp == 0 ? 0 : up_to_warp_below) + inclusive - x, total};
}

}  // namespace octocell::cuda_custom
