// SPDX-License-Identifier: MIT
// Variant 3: the same three phases; a block handles a tile of 4,096 items, and no thread waits.
// Against variant 2: one match instruction tells each lane which lanes of its warp have its digit,
//   so 32 items are ranked at once. Each tile is sorted in shared memory before it is written.
// Why it should help: ranking takes a few instructions per item instead of 32 turns. Items with the
//   same digit are written side by side, in full memory transactions. (Merrill & Grimshaw 2010;
//   ranking by match as in multisplit, Ashkiani et al. 2016.)
// What limits it: every pass reads the keys twice, once to count and once to move.
// Measured: the ladder in the report of `octocell bench-sort`, algorithm cuda_reduce_then_scan.
#include <cstdint>

#include "impl_cuda_custom/radix_sort/digit_table.cuh"

namespace octocell::cuda_custom::reduce_then_scan {
namespace {

constexpr int kWidest = 8;
constexpr int kDigits = 1 << kWidest;
constexpr int kThreads = 256;
constexpr int kWarps = kThreads / kWarpThreads;
constexpr int kItems = 16;  // per thread
constexpr std::uint32_t kTile = kThreads * kItems;
static_assert(kDigits == kThreads);  // each digit has its own thread

struct Pass {
  KeysAndValues from;
  KeysAndValues to;
  const std::uint64_t* count;
  std::uint32_t capacity;
  Digit digit;
};

/// Upsweep: counts how often each digit occurs in each tile.
__global__ void __launch_bounds__(kThreads) upsweep_kernel(Pass pass, DigitTable table) {
  __shared__ std::uint32_t counts[kDigits];
  const std::uint32_t count = pairs_to_sort(pass.count, pass.capacity);
  const std::uint32_t tile = blockIdx.x;
  if (tile * kTile >= count) return;
  counts[threadIdx.x] = 0;
  __syncthreads();
#pragma unroll
  for (int item = 0; item < kItems; ++item) {
    const std::uint32_t i = tile * kTile + item * kThreads + threadIdx.x;
    if (i < count) atomicAdd(&counts[digit_of(pass.from.keys[i], pass.digit)], 1u);
  }
  __syncthreads();
  if (threadIdx.x < 1u << pass.digit.width) table.at(threadIdx.x, tile) = counts[threadIdx.x];
}

struct Shared {
  std::uint32_t counts[kWarps][kDigits];  // of each warp; later the place in the tile of its first
                                          // key
  std::uint32_t keys[kTile];
  std::uint32_t values[kTile];
  std::uint32_t offsets[kDigits];  // from a key's place in the tile to its place in the output
  std::uint32_t tile_sums[kWarps];
  std::uint32_t digit_sums[kWarps];
};

/// Returns the place of this thread's item `item`. The items of a warp are neighbours, so warps and
/// their rounds follow the order of the input.
__device__ std::uint32_t place_in_tile(int item) {
  return (warp_of_thread() * kItems + item) * kWarpThreads + lane_of_thread();
}

/// Ranks each key: how many keys with the same digit come before it in its warp. Also counts them.
__device__ void rank_in_warp(const std::uint32_t (&keys)[kItems], std::uint32_t (&ranks)[kItems],
                             Digit which, std::uint32_t (&counts)[kDigits]) {
  for (int d = lane_of_thread(); d < kDigits; d += kWarpThreads) counts[d] = 0;
  __syncwarp();
  const unsigned lanes_below = (1u << lane_of_thread()) - 1;
#pragma unroll
  for (int item = 0; item < kItems; ++item) {
    const std::uint32_t digit = digit_of(keys[item], which);
    const unsigned peers = __match_any_sync(kAllLanes, digit);
    const int leader = __ffs(peers) - 1;
    std::uint32_t before = 0;
    if (lane_of_thread() == leader) {
      before = counts[digit];
      counts[digit] = before + __popc(peers);
    }
    __syncwarp();  // the next item may have another leader
    ranks[item] = __shfl_sync(kAllLanes, before, leader) + __popc(peers & lanes_below);
  }
}

/// Turns the counts of each warp into the places in the tile of its first keys. Also finds the
/// offsets from there to the output. Each thread handles one digit.
__device__ void place_digits(const Pass& pass, const DigitTable& table, Shared& s) {
  const std::uint32_t digit = threadIdx.x;
  std::uint32_t total = 0;
  for (int warp = 0; warp < kWarps; ++warp) total += s.counts[warp][digit];
  const std::uint32_t start = block_sums<kThreads>(total, s.tile_sums).before;
  std::uint32_t place = start;
  for (int warp = 0; warp < kWarps; ++warp) {
    const std::uint32_t count = s.counts[warp][digit];
    s.counts[warp][digit] = place;
    place += count;
  }
  const bool is_digit = digit < 1u << pass.digit.width;
  const std::uint32_t whole = is_digit ? table.row_totals[digit] : 0;
  const std::uint32_t smaller = block_sums<kThreads>(whole, s.digit_sums).before;
  s.offsets[digit] = is_digit ? smaller + table.at(digit, blockIdx.x) - start : 0;
}

/// Downsweep: sorts each tile by its digit in shared memory, then writes it.
__global__ void __launch_bounds__(kThreads) downsweep_kernel(Pass pass, DigitTable table) {
  __shared__ Shared s;
  const std::uint32_t count = pairs_to_sort(pass.count, pass.capacity);
  const std::uint32_t first = blockIdx.x * kTile;
  if (first >= count) return;
  const std::uint32_t here = min(count - first, kTile);

  // Beyond the end, keys have the largest digit: they come last and are not written.
  std::uint32_t keys[kItems];
  std::uint32_t ranks[kItems];
#pragma unroll
  for (int item = 0; item < kItems; ++item) {
    const std::uint32_t place = place_in_tile(item);
    keys[item] = place < here ? pass.from.keys[first + place] : 0xffffffffu;
  }
  rank_in_warp(keys, ranks, pass.digit, s.counts[warp_of_thread()]);
  __syncthreads();
  place_digits(pass, table, s);
  __syncthreads();
#pragma unroll
  for (int item = 0; item < kItems; ++item) {
    const std::uint32_t place = place_in_tile(item);
    const std::uint32_t digit = digit_of(keys[item], pass.digit);
    const std::uint32_t rank = s.counts[warp_of_thread()][digit] + ranks[item];
    s.keys[rank] = keys[item];
    s.values[rank] = place < here ? pass.from.values[first + place] : 0;
  }
  __syncthreads();
#pragma unroll
  for (int item = 0; item < kItems; ++item) {
    const std::uint32_t rank = item * kThreads + threadIdx.x;
    if (rank >= here) continue;
    const std::uint32_t place = s.offsets[digit_of(s.keys[rank], pass.digit)] + rank;
    pass.to.keys[place] = s.keys[rank];
    pass.to.values[place] = s.values[rank];
  }
}

}  // namespace

Shape shape(std::uint32_t capacity, int bits) {
  return {.capacity = capacity, .plan = digit_plan(bits, kWidest)};
}

std::uint64_t scratch_bytes(const Shape& shape) {
  return table_bytes(1 << shape.plan.width(), parts_of(shape.capacity, kTile));
}

void launch(const Shape& shape, const Call& call) {
  const std::uint32_t tiles = parts_of(shape.capacity, kTile);
  for (int p = 0; p < shape.plan.passes; ++p) {
    const Pass pass = {call.from(p), call.to(p), call.count, shape.capacity, shape.plan.digits[p]};
    const int digits = 1 << pass.digit.width;
    const DigitTable table = table_at(call.scratch, digits, tiles);
    upsweep_kernel<<<tiles, kThreads, 0, call.stream>>>(pass, table);
    cuda::check(cudaGetLastError());
    digit_table::sum_rows(table, digits, shape, call, kTile);
    downsweep_kernel<<<tiles, kThreads, 0, call.stream>>>(pass, table);
    cuda::check(cudaGetLastError());
  }
}

}  // namespace octocell::cuda_custom::reduce_then_scan
