// SPDX-License-Identifier: MIT
// What happens to the hits of a tile: pairs that the first float32 test could not call apart. Each
// warp collects hits until it has many, decides them, and writes them with one atomic.
#pragma once

#include <cstdint>

#include "impl_cuda_custom/pair_sinks.cuh"
#include "impl_cuda_custom/tiles/tile_layout.hpp"
#include "impl_cuda_custom/tiles/tile_test.cuh"

namespace octocell::cuda_custom::tiles {

/// The hits of a warp: words with a row's place in the low half and the other's in the high half.
template <typename Test>
class Hits {
 public:
  __device__ Hits(const Test& test, const SinkArguments& to, const TileRecord* records,
                  std::uint32_t* hits)
      : test_(test), to_(to), records_(records), hits_(hits) {}

  /// Appends the hits of those lanes that `have` one. Returns true if there is no room for 32 more.
  __device__ bool append(bool have, std::uint32_t hit) {
    const unsigned having = __ballot_sync(kAllLanes, have);
    if (having == 0) return false;
    if (have) hits_[size_ + __popc(having & lanes_below())] = hit;
    size_ += __popc(having);
    return size_ > static_cast<int>(kHits) - kWarpThreads;
  }

  /// Calls take(verdict, pair, hit) in all lanes for each 32 hits, after it has read them.
  template <typename Take>
  __device__ void decide(Take take) {
    __syncwarp();  // makes the stores of other lanes visible
    for (int first = 0; first < size_; first += kWarpThreads) {
      Verdict verdict = Verdict::apart;
      Pair pair = {};
      std::uint32_t hit = 0;
      if (first + lane() < size_) {
        hit = hits_[first + lane()];
        const TileRecord& a = records_[hit & 0xffffU];
        const TileRecord& b = records_[hit >> 16];
        pair = make_pair_of(a.id, b.id);
        verdict = test_.verdict_on(a, b, to_.spheres);
        if (verdict != Verdict::apart && to_.keeps_apart(pair)) verdict = Verdict::apart;
      }
      __syncwarp();  // `take` may overwrite hits that were read
      take(verdict, pair, hit);
    }
    __syncwarp();
    size_ = 0;
  }

 protected:
  const Test& test_;
  const SinkArguments& to_;
  const TileRecord* const records_;
  std::uint32_t* const hits_;
  int size_ = 0;  // the same in all lanes
};

/// Stores pairs, and uncertain pairs for stage 6.
template <typename Test>
class KeepHits : Hits<Test> {
 public:
  static constexpr int kBlocksAtOnce = 2;
  struct Shared {
    int sizes[kFindWarps];
    std::uint64_t place;
  };
  __device__ KeepHits(const Test& test, const SinkArguments& to, const TileRecord* records,
                      std::uint32_t* hits, Shared& shared)
      : Hits<Test>(test, to, records, hits), shared_(shared) {}

  /// All lanes of the warp must call it.
  __device__ void push(bool have, std::uint32_t hit) {
    if (this->append(have, hit)) flush();
  }

  /// Writes what all warps still hold, with one atomic. All threads of the block must call it once,
  /// at the end.
  __device__ void close() {
    const int certain = keep_certain();
    if (lane() == 0) shared_.sizes[warp()] = certain;
    __syncthreads();
    int before = 0;
    int total = 0;
    for (int w = 0; w < kFindWarps; ++w) {
      if (w < warp()) before += shared_.sizes[w];
      total += shared_.sizes[w];
    }
    if (total == 0) return;
    if (threadIdx.x == 0) shared_.place = atomic_add(this->to_.pairs.size, total);
    __syncthreads();
    const std::uint64_t place = shared_.place;
    if (place + total <= this->to_.pairs.capacity) write(place + before, certain);
  }

 private:
  __device__ void flush() {
    const int certain = keep_certain();
    std::uint64_t place = 0;
    if (lane() == 0) place = atomic_add(this->to_.pairs.size, certain);
    place = __shfl_sync(kAllLanes, place, 0);
    if (place + certain <= this->to_.pairs.capacity) write(place, certain);
    __syncwarp();  // the next push may overwrite the places
  }

  /// Decides all hits, lists the uncertain ones, and keeps only certain pairs. Returns how many.
  __device__ int keep_certain() {
    int certain = 0;
    this->decide([&](Verdict verdict, Pair pair, std::uint32_t hit) {
      list_uncertain(verdict == Verdict::uncertain, pair);
      const unsigned overlapping = __ballot_sync(kAllLanes, verdict == Verdict::overlap);
      if (verdict == Verdict::overlap) {
        this->hits_[certain + __popc(overlapping & lanes_below())] = hit;
      }
      certain += __popc(overlapping);
    });
    return certain;
  }

  __device__ void list_uncertain(bool have, Pair pair) const {
    const unsigned having = __ballot_sync(kAllLanes, have);
    if (having == 0) return;
    const PairList& list = this->to_.uncertain_pairs;
    std::uint64_t place = 0;
    if (lane() == 0) place = atomic_add(list.size, __popc(having));
    place = __shfl_sync(kAllLanes, place, 0);
    if (place + __popc(having) > list.capacity || !have) return;
    list.items[place + __popc(having & lanes_below())] = pair;
  }

  __device__ void write(std::uint64_t place, int count) const {
    for (int k = lane(); k < count; k += kWarpThreads) {
      const std::uint32_t hit = this->hits_[k];
      this->to_.pairs.items[place + k] =
          make_pair_of(this->records_[hit & 0xffffU].id, this->records_[hit >> 16].id);
    }
  }

  Shared& shared_;
};

/// For a count_only plan, which cannot store uncertain pairs: decides them where they are found.
template <typename Test>
class CountHits : Hits<Test> {
 public:
  static constexpr int kBlocksAtOnce = 1;  // the exact test needs many registers
  struct Shared {
    std::uint64_t sums[kFindWarps];
  };
  __device__ CountHits(const Test& test, const SinkArguments& to, const TileRecord* records,
                       std::uint32_t* hits, Shared&)
      : Hits<Test>(test, to, records, hits) {}

  __device__ void push(bool have, std::uint32_t hit) {
    if (this->append(have, hit)) count();
  }
  __device__ void close() {
    count();
    add_over_warp(&this->to_.state->pairs, pairs_);
    add_over_warp(&this->to_.state->uncertain_pairs, uncertain_pairs_);
    add_over_warp(&this->to_.state->checksum, checksum_);
  }

 private:
  __device__ void count() {
    this->decide([&](Verdict verdict, Pair pair, std::uint32_t) {
      if (verdict == Verdict::apart) return;
      if (verdict == Verdict::uncertain) {
        ++uncertain_pairs_;
        if (!overlap(this->to_.spheres, pair)) return;
      }
      ++pairs_;
      checksum_ += mix_pair(pair);
    });
  }

  __device__ static void add_over_warp(std::uint64_t* sum, std::uint64_t value) {
    const std::uint64_t of_warp = sum_over_warp(value);
    if (lane() == 0 && of_warp != 0) atomic_add(sum, of_warp);
  }

  std::uint64_t pairs_ = 0;
  std::uint64_t uncertain_pairs_ = 0;
  std::uint64_t checksum_ = 0;
};

}  // namespace octocell::cuda_custom::tiles
