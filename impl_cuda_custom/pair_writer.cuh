// SPDX-License-Identifier: MIT
// How many warps write one list. Each warp fills a small block of its own in shared memory, then
// reserves that much of the list with one atomic addition and copies. (The threads of impl_cpu do
// the same.)
#pragma once

#include <cstdint>

#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {

/// A list in device memory. Past its end, it continues to count but writes nothing.
struct PairList {
  Pair* items;
  std::uint64_t capacity;
  std::uint64_t* size;
};

class PairWriter {
 public:
  static constexpr int kWarpRoom = 3 * kWarpThreads;
  struct Shared {
    Pair items[kBlockWarps][kWarpRoom];
    int sizes[kBlockWarps];
    std::uint64_t place;
  };

  __device__ PairWriter(const PairList& list, Shared& shared) : list_(list), shared_(shared) {}

  /// Appends the pairs of those lanes that `have` one. All lanes of the warp must call it.
  __device__ void push(bool have, Pair pair) {
    const unsigned having = __ballot_sync(kAllLanes, have);
    if (having == 0) return;
    if (have) shared_.items[warp()][size_ + __popc(having & lanes_below())] = pair;
    size_ += __popc(having);
    if (size_ > kWarpRoom - kWarpThreads) flush_warp();
  }

  /// Writes what all warps still hold, with one atomic. All threads of the block must call it once,
  /// at the end.
  __device__ void close() {
    if (lane() == 0) shared_.sizes[warp()] = size_;
    __syncthreads();
    int before = 0;
    int total = 0;
    for (int w = 0; w < kBlockWarps; ++w) {
      if (w < warp()) before += shared_.sizes[w];
      total += shared_.sizes[w];
    }
    if (total == 0) return;
    if (threadIdx.x == 0) shared_.place = atomic_add(list_.size, static_cast<unsigned>(total));
    __syncthreads();
    if (shared_.place + total <= list_.capacity) copy_to(shared_.place + before);
  }

 private:
  __device__ void flush_warp() {
    __syncwarp();  // makes the stores of other lanes visible
    std::uint64_t place = 0;
    if (lane() == 0) place = atomic_add(list_.size, static_cast<unsigned>(size_));
    place = __shfl_sync(kAllLanes, place, 0);
    if (place + size_ <= list_.capacity) copy_to(place);
    __syncwarp();
    size_ = 0;
  }

  __device__ void copy_to(std::uint64_t place) const {
    for (int k = lane(); k < size_; k += kWarpThreads) {
      list_.items[place + k] = shared_.items[warp()][k];
    }
  }

  const PairList list_;
  Shared& shared_;
  int size_ = 0;  // of this warp's block; the same in all its lanes
};

}  // namespace octocell::cuda_custom
