// SPDX-License-Identifier: MIT
// Variant 2: digits of 8 bits, in three phases (GPU Gems 3, chapter 32): tabulate, sum, reorder.
// Against variant 1: a pass sorts by 8 bits instead of one. A group of 32 threads has 256 counters,
//   one for each value of the digit, and its own part of the input.
// Why it should help: 32-bit keys cross the memory 4 times instead of 32.
// What limits it: to stay stable, the 32 threads update the counters one after another, 32 steps
//   for 32 items; and neighbours in the input are written far apart.
// Measured: the ladder in the report of `octocell bench-sort`, algorithm cuda_digit_passes.
#include <cstdint>

#include "impl_cuda_custom/radix_sort/digit_table.cuh"

namespace octocell::cuda_custom::digit_passes {
namespace {

constexpr int kWidest = 8;
constexpr int kCounters = 1 << kWidest;
constexpr int kThreads = 256;
constexpr int kGroups = kThreads / kWarpThreads;
constexpr int kRounds = 64;
constexpr std::uint32_t kPart = kWarpThreads * kRounds;  // items of a group
static_assert(kCounters == kThreads);                    // each digit's start has its own thread

struct Pass {
  KeysAndValues from;
  KeysAndValues to;
  const std::uint64_t* count;
  std::uint32_t capacity;
  Digit digit;
};

__device__ std::uint32_t part_of_group() { return blockIdx.x * kGroups + warp_of_thread(); }

/// Phase 1, setup and tabulation: counts how often each digit occurs in each group's part.
__global__ void __launch_bounds__(kThreads) tabulate_kernel(Pass pass, DigitTable table) {
  __shared__ std::uint32_t all_counters[kGroups][kCounters];
  const std::uint32_t count = pairs_to_sort(pass.count, pass.capacity);
  const std::uint32_t part = part_of_group();
  if (part * kPart >= count) return;
  std::uint32_t(&counters)[kCounters] = all_counters[warp_of_thread()];
  for (int d = lane_of_thread(); d < kCounters; d += kWarpThreads) counters[d] = 0;
  __syncwarp();
  for (int round = 0; round < kRounds; ++round) {
    const std::uint32_t i = part * kPart + round * kWarpThreads + lane_of_thread();
    if (i < count) atomicAdd(&counters[digit_of(pass.from.keys[i], pass.digit)], 1u);
  }
  __syncwarp();
  for (int d = lane_of_thread(); d < 1 << pass.digit.width; d += kWarpThreads) {
    table.at(d, part) = counters[d];
  }
}

/// Finds where the first key with each digit goes: adds up all smaller digits. (Phase 2, radix
/// summation, is sum_rows() for the parts of each digit.)
__device__ void find_digit_starts(const Pass& pass, const DigitTable& table,
                                  std::uint32_t (&starts)[kCounters]) {
  __shared__ std::uint32_t warp_sums[kGroups];
  const bool is_digit = threadIdx.x < 1u << pass.digit.width;
  const std::uint32_t total = is_digit ? table.row_totals[threadIdx.x] : 0;
  starts[threadIdx.x] = block_sums<kThreads>(total, warp_sums).before;
  __syncthreads();
}

/// Phase 3, reordering: each key goes to the place of its counter, which then advances.
__global__ void __launch_bounds__(kThreads) reorder_kernel(Pass pass, DigitTable table) {
  __shared__ std::uint32_t all_counters[kGroups][kCounters];
  __shared__ std::uint32_t starts[kCounters];
  find_digit_starts(pass, table, starts);
  const std::uint32_t count = pairs_to_sort(pass.count, pass.capacity);
  const std::uint32_t part = part_of_group();
  if (part * kPart >= count) return;
  volatile std::uint32_t* const counters = all_counters[warp_of_thread()];
  for (int d = lane_of_thread(); d < 1 << pass.digit.width; d += kWarpThreads) {
    counters[d] = starts[d] + table.at(d, part);
  }
  __syncwarp();
  for (int round = 0; round < kRounds; ++round) {
    const std::uint32_t i = part * kPart + round * kWarpThreads + lane_of_thread();
    const std::uint32_t key = i < count ? pass.from.keys[i] : 0;
    const std::uint32_t digit = digit_of(key, pass.digit);
    std::uint32_t place = 0;
    for (int turn = 0; turn < kWarpThreads; ++turn) {
      if (turn == lane_of_thread() && i < count) {
        place = counters[digit];
        counters[digit] = place + 1;
      }
      __syncwarp();
    }
    if (i < count) {
      pass.to.keys[place] = key;
      pass.to.values[place] = pass.from.values[i];
    }
  }
}

}  // namespace

Shape shape(std::uint32_t capacity, int bits) {
  return {.capacity = capacity, .plan = digit_plan(bits, kWidest)};
}

std::uint64_t scratch_bytes(const Shape& shape) {
  return table_bytes(1 << shape.plan.width(), parts_of(shape.capacity, kPart));
}

void launch(const Shape& shape, const Call& call) {
  const std::uint32_t parts = parts_of(shape.capacity, kPart);
  const std::uint32_t blocks = parts_of(parts, kGroups);
  for (int p = 0; p < shape.plan.passes; ++p) {
    const Pass pass = {call.from(p), call.to(p), call.count, shape.capacity, shape.plan.digits[p]};
    const int digits = 1 << pass.digit.width;
    const DigitTable table = table_at(call.scratch, digits, parts);
    tabulate_kernel<<<blocks, kThreads, 0, call.stream>>>(pass, table);
    cuda::check(cudaGetLastError());
    digit_table::sum_rows(table, digits, shape, call, kPart);
    reorder_kernel<<<blocks, kThreads, 0, call.stream>>>(pass, table);
    cuda::check(cudaGetLastError());
  }
}

}  // namespace octocell::cuda_custom::digit_passes
