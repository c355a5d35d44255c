// SPDX-License-Identifier: MIT
// The first kernel of onesweep. It counts how often each value of each digit occurs, for all passes
// in one read of the keys (no pass changes the counts). From that it computes where the first key
// with each value goes. It also resets the look-back words. Kernels that make keys can use its
// parts: open(), count_key() for each key while it is in a register, close().
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/cuda/cuda.cuh"
#include "impl_cuda_custom/radix_sort/device_tools.cuh"
#include "impl_cuda_custom/radix_sort/look_back.cuh"
#include "impl_cuda_custom/radix_sort/variants.cuh"

namespace octocell::cuda_custom::digit_histograms {

constexpr int kMostPasses = 4;  // 32 bits in digits of 8 to 10
constexpr int kThreads = 512;
constexpr int kItems = 8;  // per thread; all are loaded before the first is counted
constexpr std::uint32_t kStep = kThreads * kItems;
constexpr std::uint32_t kMostBlocks = 512;  // fills the chip; each block adds its bins to the
                                            // common ones

/// This limits the registers so that all blocks fit at once on a multiprocessor with 2,048 threads.
/// With more registers, the last quarter of the blocks ran alone, and the kernel took a quarter
/// longer.
#if defined(__CUDA_ARCH__) && (__CUDA_ARCH__ == 800 || __CUDA_ARCH__ == 900 || \
                               __CUDA_ARCH__ == 1000 || __CUDA_ARCH__ == 1030)
constexpr int kBlocksAtOnce = 4;
#else
constexpr int kBlocksAtOnce = 2;
#endif

struct HistogramsJob {
  const std::uint32_t* keys;
  const std::uint64_t* count;
  std::uint32_t capacity;
  Digit digits[kMostPasses];
  int bins;                    // per pass; a power of two, at most 2 * kThreads
  std::uint32_t* starts;       // [passes][bins] in: zeros; out: where a digit's first key goes
  std::uint32_t* blocks_done;  // in: zero
  std::uint64_t* words;        // look-back: [kMargin + tiles][words_per_tile]
  std::uint32_t words_per_tile;
  std::uint32_t tile_items;
};

__device__ inline void reset_look_back(const HistogramsJob& job, std::uint32_t count) {
  const std::uint64_t tiles = look_back::kMargin + parts_of(count, job.tile_items);
  const std::uint64_t words = tiles * job.words_per_tile;
  const std::uint64_t threads = std::uint64_t{gridDim.x} * kThreads;
  for (std::uint64_t i = std::uint64_t{blockIdx.x} * kThreads + threadIdx.x; i < words;
       i += threads) {
    job.words[i] = 0;
  }
}

template <int kPasses>
__device__ void count_key(const HistogramsJob& job, std::uint32_t key, std::uint32_t* counts) {
#pragma unroll
  for (int pass = 0; pass < kPasses; ++pass) {
    const Digit digit = job.digits[pass];
    const std::uint32_t value = key >> digit.shift & ((1u << digit.width) - 1);
    atomicAdd(&counts[pass * job.bins + value], 1u);
  }
}

/// Counts the keys from `first` on. A whole step has no branch after each key, so its loads and
/// counts overlap.
template <int kPasses, bool kWhole>
__device__ void count_step(const HistogramsJob& job, std::uint32_t first, std::uint32_t count,
                           std::uint32_t* counts) {
  std::uint32_t keys[kItems];
#pragma unroll
  for (int item = 0; item < kItems; ++item) {
    const std::uint32_t i = first + item * kThreads + threadIdx.x;
    keys[item] = kWhole || i < count ? job.keys[i] : 0;
  }
#pragma unroll
  for (int item = 0; item < kItems; ++item) {
    if (!kWhole && first + item * kThreads + threadIdx.x >= count) break;
    count_key<kPasses>(job, keys[item], counts);
  }
}

template <int kPasses>
__device__ void count_digits(const HistogramsJob& job, std::uint32_t count, std::uint32_t* counts) {
  for (std::uint32_t first = blockIdx.x * kStep; first < count; first += gridDim.x * kStep) {
    if (count - first >= kStep) {
      count_step<kPasses, true>(job, first, count, counts);
    } else {
      count_step<kPasses, false>(job, first, count, counts);
    }
  }
}

/// Returns true in the block that ends last; that block then sees what all others have added.
__device__ inline bool is_last_block(std::uint32_t* blocks_done) {
  __shared__ bool last;
  __threadfence();  // this thread's sums must be visible before its block reports that it is done
  __syncthreads();
  if (threadIdx.x == 0) last = atomicAdd(blocks_done, 1u) == gridDim.x - 1;
  __syncthreads();
  __threadfence();
  return last;
}

/// Turns the counts of each pass into starts. A thread has two neighbouring bins of each pass and
/// loads all of them before it adds up the first.
template <int kPasses>
__device__ void sum_bins(std::uint32_t* bins, int size) {
  __shared__ std::uint32_t warp_sums[kPasses][kThreads / kWarpThreads];
  const int bin = 2 * static_cast<int>(threadIdx.x);
  uint2 counts[kPasses];
#pragma unroll
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto* const mine = reinterpret_cast<const uint2*>(bins + pass * size + bin);
    counts[pass] = bin < size ? __ldcg(mine) : uint2{0, 0};
  }
#pragma unroll
  for (int pass = 0; pass < kPasses; ++pass) {
    const uint2 mine = counts[pass];
    const std::uint32_t before = block_sums<kThreads>(mine.x + mine.y, warp_sums[pass]).before;
    if (bin < size) *reinterpret_cast<uint2*>(bins + pass * size + bin) = {before, before + mine.x};
  }
}

/// Clears the block's counts ([kPasses][job.bins], shared by its kThreads threads) and its part of
/// the look-back words. `count` is the number of keys to come.
template <int kPasses>
__device__ void open(const HistogramsJob& job, std::uint32_t count, std::uint32_t* counts) {
  for (int i = threadIdx.x; i < kPasses * job.bins; i += kThreads) counts[i] = 0;
  __syncthreads();
  reset_look_back(job, count);
}

/// Adds the block's counts to the common ones. Returns true in the block that ends last: it has
/// turned them into starts, and it sees what all other blocks have written.
template <int kPasses>
__device__ bool close(const HistogramsJob& job, const std::uint32_t* counts) {
  __syncthreads();
  for (int i = threadIdx.x; i < kPasses * job.bins; i += kThreads) {
    if (counts[i] != 0) atomicAdd(&job.starts[i], counts[i]);
  }
  if (!is_last_block(job.blocks_done)) return false;
  sum_bins<kPasses>(job.starts, job.bins);
  return true;
}

template <int kPasses>
__global__ void __launch_bounds__(kThreads, kBlocksAtOnce) histograms_kernel(HistogramsJob job) {
  extern __shared__ std::uint32_t counts[];
  const std::uint32_t count = pairs_to_sort(job.count, job.capacity);
  open<kPasses>(job, count, counts);
  count_digits<kPasses>(job, count, counts);
  close<kPasses>(job, counts);
}

inline std::size_t shared_bytes(const HistogramsJob& job, int passes) {
  return sizeof(std::uint32_t) * static_cast<std::size_t>(passes * job.bins);
}

inline void launch(const HistogramsJob& job, int passes, cudaStream_t stream) {
  constexpr void (*kByPasses[])(HistogramsJob) = {histograms_kernel<1>, histograms_kernel<2>,
                                                  histograms_kernel<3>, histograms_kernel<4>};
  const std::uint32_t blocks = std::min(parts_of(job.capacity, kStep), kMostBlocks);
  kByPasses[passes - 1]<<<blocks, kThreads, shared_bytes(job, passes), stream>>>(job);
  cuda::check(cudaGetLastError());
}

}  // namespace octocell::cuda_custom::digit_histograms
