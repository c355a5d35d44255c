// SPDX-License-Identifier: MIT
// Variant 1: one bit a pass. Zeros go to the front, ones behind them; each group keeps its order.
// Against the variant below: there is none. This is the shortest code that sorts in parallel.
// Why it works: a stable split by each bit in turn, the lowest first, sorts (Blelloch 1990). The
//   place of an item follows from the number of ones before it, a prefix sum of the flags.
// Measured: the ladder in the report of `octocell bench-sort`, algorithm cuda_one_bit_split.
#include <cstdint>

#include "impl_cuda_custom/radix_sort/digit_table.cuh"

namespace octocell::cuda_custom::one_bit_split {
namespace {

constexpr int kThreads = 512;
constexpr int kRounds = 8;
constexpr std::uint32_t kTile = kThreads * kRounds;  // items of a block

struct Split {
  KeysAndValues from;
  KeysAndValues to;
  const std::uint64_t* count;
  std::uint32_t capacity;
  int bit;
};

__device__ bool is_one(std::uint32_t key, int bit) { return (key >> bit & 1) != 0; }

/// Counts the ones of each block's tile.
__global__ void __launch_bounds__(kThreads) count_ones_kernel(Split split, DigitTable ones) {
  const std::uint32_t count = pairs_to_sort(split.count, split.capacity);
  const std::uint32_t tile = blockIdx.x;
  if (tile * kTile >= count) return;
  std::uint32_t found = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::uint32_t i = tile * kTile + round * kThreads + threadIdx.x;
    found += __syncthreads_count(i < count && is_one(split.from.keys[i], split.bit));
  }
  if (threadIdx.x == 0) ones.at(0, tile) = found;
}

/// Moves each item to its side. `ones` holds how many ones come before each tile.
__global__ void __launch_bounds__(kThreads) scatter_kernel(Split split, DigitTable ones) {
  __shared__ std::uint32_t warp_sums[kThreads / kWarpThreads];
  const std::uint32_t count = pairs_to_sort(split.count, split.capacity);
  const std::uint32_t tile = blockIdx.x;
  if (tile * kTile >= count) return;
  const std::uint32_t zeros = count - ones.row_totals[0];
  std::uint32_t ones_before = ones.at(0, tile);
  for (int round = 0; round < kRounds; ++round) {
    const std::uint32_t i = tile * kTile + round * kThreads + threadIdx.x;
    const std::uint32_t key = i < count ? split.from.keys[i] : 0;
    const bool one = is_one(key, split.bit);
    const Sums sums = block_sums<kThreads>(one ? 1 : 0, warp_sums);
    const std::uint32_t before = ones_before + sums.before;
    const std::uint32_t place = one ? zeros + before : i - before;
    if (i < count) {
      split.to.keys[place] = key;
      split.to.values[place] = split.from.values[i];
    }
    ones_before += sums.total;
    __syncthreads();  // the next round uses warp_sums again
  }
}

}  // namespace

Shape shape(std::uint32_t capacity, int bits) {
  return {.capacity = capacity, .plan = digit_plan(bits, 1)};
}

std::uint64_t scratch_bytes(const Shape& shape) {
  return table_bytes(1, parts_of(shape.capacity, kTile));
}

void launch(const Shape& shape, const Call& call) {
  const std::uint32_t tiles = parts_of(shape.capacity, kTile);
  const DigitTable ones = table_at(call.scratch, 1, tiles);
  for (int bit = 0; bit < shape.plan.passes; ++bit) {
    const Split split = {call.from(bit), call.to(bit), call.count, shape.capacity, bit};
    count_ones_kernel<<<tiles, kThreads, 0, call.stream>>>(split, ones);
    cuda::check(cudaGetLastError());
    digit_table::sum_rows(ones, 1, shape, call, kTile);
    scatter_kernel<<<tiles, kThreads, 0, call.stream>>>(split, ones);
    cuda::check(cudaGetLastError());
  }
}

}  // namespace octocell::cuda_custom::one_bit_split
