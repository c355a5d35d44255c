// SPDX-License-Identifier: MIT
// What a block of onesweep does with its tile: load, rank, order in shared memory, look back,
// write.
#pragma once

#include <cuda_pipeline.h>

#include <cstddef>
#include <cstdint>

#include "impl_cuda_custom/radix_sort/device_tools.cuh"
#include "impl_cuda_custom/radix_sort/look_back.cuh"
#include "impl_cuda_custom/radix_sort/peers.cuh"
#include "impl_cuda_custom/radix_sort/variants.cuh"

namespace octocell::cuda_custom::onesweep {

/// How pairs are stored: as the caller's two arrays, or, between two passes, with each key beside
/// its value.
enum class Form : std::uint8_t { arrays, pairs };

__host__ __device__ inline uint2* pairs_of(const KeysAndValues& side) {
  return reinterpret_cast<uint2*>(side.keys);
}

/// One pass over all tiles.
struct Pass {
  KeysAndValues from;
  KeysAndValues to;
  const std::uint64_t* count;
  std::uint32_t capacity;
  const std::uint32_t* out_of_order;  // may be null
  bool takes_over;  // true if this pass copies input that is already in order to where the result
                    // is expected
  Digit digit;
  const std::uint32_t* starts;  // [bins] where the first key with each digit goes
  std::uint32_t* next_tile;
  std::uint64_t* words;  // look-back: [tiles][bins / 2], behind a margin
  look_back::States states;
  std::uint32_t ones;  // kOnes
};

/// Threads of a block, by the widest digit; 512 threads use all registers of a multiprocessor.
constexpr int kThreadsAtOnce = 512;
constexpr int threads_of(int digit_bits) { return digit_bits <= 8 ? 256 : kThreadsAtOnce; }

/// A block and its tile. The counters of two neighbouring digits, 16 bits each, share a word (a
/// tile has fewer than 2^16 items). A thread that owns a word owns both digits: it sums them up in
/// one addition, and its look-back word holds both.
template <int kDigitBits, int kItems, Form kFrom, Form kTo>
class Tile {
 public:
  static constexpr int kThreads = threads_of(kDigitBits);
  static constexpr int kWarps = kThreads / kWarpThreads;
  static constexpr std::uint32_t kBins = 1u << kDigitBits;
  static constexpr std::uint32_t kOwners = kBins / 2;
  static constexpr std::uint32_t kSize = kThreads * kItems;
  static constexpr int kAbreast = 2;                    // items that a thread ranks at once
  static constexpr int kAtOnce = kItems <= 16 ? 8 : 4;  // look-back: see sum_below()
  static_assert(kAtOnce <= look_back::kMostAtOnce);
  static_assert(kOwners <= kThreads && kSize < 1u << 16 && kItems % 4 == 0);

  struct Shared {
    union {  // the counts are no longer needed when the first key is put in order
      std::uint32_t counts[kWarps][kOwners];
      std::uint32_t keys[kSize];
    };
    alignas(16) std::uint32_t values[kSize];
    std::uint32_t offsets[kBins];  // from a key's place in the tile to its place in the output
    std::uint32_t warp_sums[kWarps];
    std::uint32_t number;
  };

  __device__ Tile(const Pass& pass, Shared& shared) : pass_(pass), s_(shared) {}

  /// Takes the next tile; returns false if none is left. Numbers come from a counter, not from
  /// blockIdx, so all tiles below have started.
  __device__ bool take() {
    const std::uint32_t count = pairs_to_sort(pass_.count, pass_.capacity);
    if (threadIdx.x == 0) s_.number = atomicAdd(pass_.next_tile, 1u);
    __syncthreads();
    number_ = s_.number;
    if (number_ >= parts_of(count, kSize)) return false;
    first_ = number_ * kSize;
    here_ = min(count - first_, kSize);
    return true;
  }

  /// Loads the tile. Beyond the end, keys have the largest digit: they come last and are not
  /// written.
  __device__ void load() {
    if constexpr (kFrom == Form::pairs) {
      load_pairs();
    } else {
      load_keys();
      fetch_values();
    }
  }

  /// Ranks each key: how many keys with the same digit come before it in its warp. Also counts
  /// them.
  __device__ void rank_in_warps() {
    std::uint32_t(&counts)[kOwners] = s_.counts[warp_of_thread()];
    for (std::uint32_t i = lane_of_thread(); i < kOwners; i += kWarpThreads) counts[i] = 0;
    __syncwarp();
#pragma unroll
    for (int item = 0; item < kItems; item += kAbreast) rank_abreast(item, counts);
    forget(keys_);
    __syncthreads();
  }

  /// Turns ranks in a warp into ranks in the tile; owners publish their tile's counts as soon as
  /// possible.
  __device__ void rank_in_tile() {
    std::uint32_t counts = 0;
    if (is_owner()) {
#pragma unroll
      for (int warp = 0; warp < kWarps; ++warp) counts += s_.counts[warp][threadIdx.x];
    }
    even_ = counts & 0xffff;
    odd_ = counts >> 16;
    if (is_owner()) publish(number_ == 0 ? pass_.states.whole : pass_.states.own, own_counts());
    const std::uint32_t start = block_sums<kThreads>(even_ + odd_, s_.warp_sums).before;
    if (is_owner()) place_digits(start);
    __syncthreads();
#pragma unroll
    for (int item = 0; item < kItems; ++item) {
      const std::uint32_t digit = digit_of(keys_[item]);
      add_to_rank(item, s_.counts[warp_of_thread()][digit / 2] >> half(digit) & 0xffff);
    }
    __syncthreads();  // the ordered keys will overwrite the counts
  }

  __device__ void order() {
#pragma unroll
    for (int item = 0; item < kItems; ++item) s_.keys[rank(item)] = keys_[item];
    forget(ranks_);
    if constexpr (kFrom == Form::arrays) collect_values();
#pragma unroll
    for (int item = 0; item < kItems; ++item) s_.values[rank(item)] = values_[item];
  }

  /// Finds where each digit of this tile goes: adds the counts of the tiles below.
  __device__ void look_back() {
    if (is_owner() && number_ != 0) {
      const std::uint64_t below =
          look_back::sum_below<kOwners, kAtOnce>(word() - kOwners, pass_.states);
      publish(pass_.states.whole, below + own_counts());
      s_.offsets[2 * threadIdx.x] += look_back::even_of(below);
      s_.offsets[2 * threadIdx.x + 1] += look_back::odd_of(below);
    }
    __syncthreads();
  }

  __device__ void write() const {
    if (here_ == kSize) return write_items<true>();
    write_items<false>();
  }

 private:
  /// The items of a warp are neighbours, so warps and their items follow the order of the input.
  __device__ static std::uint32_t first_of_warp() {
    return warp_of_thread() * kItems * kWarpThreads;
  }
  __device__ void load_pairs() {
    const std::uint32_t place = first_of_warp() + lane_of_thread();
    const int left = static_cast<int>(here_) - static_cast<int>(place);
    const uint2* const mine = pairs_of(pass_.from) + first_ + place;
#pragma unroll
    for (int item = 0; item < kItems; ++item) {
      const int i = item * kWarpThreads;
      const uint2 pair = i < left ? mine[i] : make_uint2(0xffffffffu, 0);
      keys_[item] = pair.x;
      values_[item] = pair.y;
    }
  }
  __device__ void load_keys() {
    const std::uint32_t place = first_of_warp() + lane_of_thread();
    const int left = static_cast<int>(here_) - static_cast<int>(place);
    const std::uint32_t* const mine = pass_.from.keys + first_ + place;
#pragma unroll
    for (int item = 0; item < kItems; ++item) {
      const int i = item * kWarpThreads;
      keys_[item] = i < left ? mine[i] : 0xffffffffu;
    }
  }
  /// Copies values to shared memory, in the order of the input, while keys are ranked. Four at a
  /// time; up to three at the end one by one.
  __device__ void fetch_values() {
#pragma unroll
    for (int k = 0; k < kItems / 4; ++k) {
      const std::uint32_t i = first_of_warp() + (k * kWarpThreads + lane_of_thread()) * 4;
      if (i >= here_) break;
      const std::uint32_t* const four = pass_.from.values + first_ + i;
      if (i + 4 <= here_) {
        __pipeline_memcpy_async(&s_.values[i], four, 16);
      } else {
        for (std::uint32_t j = 0; i + j < here_; ++j) s_.values[i + j] = four[j];
      }
    }
    __pipeline_commit();
  }
  /// Loads the values into registers. A warp reads only what its own lanes fetched.
  __device__ void collect_values() {
    __pipeline_wait_prior(0);
    __syncwarp();
#pragma unroll
    for (int item = 0; item < kItems; ++item) {
      values_[item] = s_.values[first_of_warp() + item * kWarpThreads + lane_of_thread()];
    }
    __syncthreads();  // all must read before the first writes
  }

  /// Writes the items. Keys with the same digit are side by side, here and in the output. A full
  /// tile needs no branch after each item, so its reads overlap.
  template <bool kFull>
  __device__ void write_items() const {
#pragma unroll
    for (int item = 0; item < kItems; ++item) {
      const std::uint32_t rank = item * kThreads + threadIdx.x;
      if (!kFull && rank >= here_) break;
      const std::uint32_t key = s_.keys[rank];
      const std::uint32_t place = s_.offsets[digit_of(key)] + rank;
      if constexpr (kTo == Form::pairs) {
        pairs_of(pass_.to)[place] = make_uint2(key, s_.values[rank]);
      } else {
        pass_.to.keys[place] = key;
        pass_.to.values[place] = s_.values[rank];
      }
    }
  }
  __device__ std::uint32_t digit_of(std::uint32_t key) const {
    return key >> pass_.digit.shift & ((1u << pass_.digit.width) - 1);
  }
  /// Returns the shift of the half word that counts a digit.
  __device__ static std::uint32_t half(std::uint32_t digit) { return digit % 2 * 16; }
  __device__ std::uint32_t rank(int item) const {
    return ranks_[item / 2] >> item % 2 * 16 & 0xffff;
  }
  __device__ void add_to_rank(int item, std::uint32_t places) {
    ranks_[item / 2] += places << item % 2 * 16;
  }
  __device__ static bool is_owner() { return threadIdx.x < kOwners; }

  /// Ranks kAbreast items from `first` on in their warp.
  __device__ void rank_abreast(int first, std::uint32_t (&counts)[kOwners]) {
    const unsigned lanes_up_to_here = kAllLanes >> (kWarpThreads - 1 - lane_of_thread());
    std::uint32_t digits[kAbreast];
    unsigned peers[kAbreast];
    std::uint32_t before[kAbreast] = {};
#pragma unroll
    for (int k = 0; k < kAbreast; ++k) digits[k] = digit_of(keys_[first + k]);
    find_peers<kDigitBits>(digits, pass_.ones, peers);
#pragma unroll
    for (int k = 0; k < kAbreast; ++k) {
      const std::uint32_t up_to_here = __popc(peers[k] & lanes_up_to_here);
      const std::uint32_t added = up_to_here << half(digits[k]);
      std::uint32_t* const count = &counts[digits[k] / 2];
      if (lane_of_thread() == leader(peers[k])) before[k] = atomicAdd(count, added);
      __syncwarp();  // two leaders may share a word, and items must count in their order
      add_to_rank(first + k, up_to_here - 1);
    }
#pragma unroll
    for (int k = 0; k < kAbreast; ++k) {
      const std::uint32_t word = __shfl_sync(kAllLanes, before[k], leader(peers[k]));
      add_to_rank(first + k, word >> half(digits[k]) & 0xffff);
    }
    forget(ranks_[first / 2]);
  }

  /// Returns the last lane with a digit, which has counted all of them.
  __device__ static int leader(unsigned peers) { return kWarpThreads - 1 - __clz(peers); }

  /// Returns an owner's look-back word of this tile.
  __device__ std::uint64_t* word() const {
    return pass_.words + std::size_t{number_} * kOwners + threadIdx.x;
  }
  __device__ std::uint64_t own_counts() const { return look_back::pack(even_, odd_); }
  __device__ void publish(std::uint64_t state, std::uint64_t counts) const {
    look_back::write(word(), state | counts);
  }

  /// Turns a warp's counts into the places of its first keys. `start` is where the even digit
  /// begins in the tile. Sets the offsets as if no tile were below.
  __device__ void place_digits(std::uint32_t start) {
    const std::uint32_t digit = 2 * threadIdx.x;
    const std::uint32_t even_start = pass_.starts[digit];
    const std::uint32_t odd_start = pass_.starts[digit + 1];
    std::uint32_t places = start | (start + even_) << 16;
#pragma unroll
    for (int warp = 0; warp < kWarps; ++warp) {
      const std::uint32_t next = places + s_.counts[warp][threadIdx.x];
      s_.counts[warp][threadIdx.x] = places;
      places = next;
    }
    s_.offsets[digit] = even_start - start;
    s_.offsets[digit + 1] = odd_start - start - even_;
  }

  const Pass& pass_;
  Shared& s_;
  std::uint32_t number_;
  std::uint32_t first_;  // first item of the tile
  std::uint32_t here_;   // items of the tile; kSize except in the last one
  std::uint32_t keys_[kItems];
  std::uint32_t values_[kItems];
  std::uint32_t ranks_[kItems / 2] = {};  // two in a word, to save registers
  std::uint32_t even_ = 0;                // how often an owner's two digits occur in the tile
  std::uint32_t odd_ = 0;
};

}  // namespace octocell::cuda_custom::onesweep
