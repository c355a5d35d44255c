// SPDX-License-Identifier: MIT
// The table of variants 1 to 3: how often each digit occurs in each part of the input. It has a row
// for each digit and a column for each part. Summing up turns counts into places.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/cuda/cuda.cuh"
#include "impl_cuda_custom/radix_sort/device_tools.cuh"
#include "impl_cuda_custom/radix_sort/variants.cuh"

namespace octocell::cuda_custom {

struct DigitTable {
  std::uint32_t* entries;     // [rows][columns]
  std::uint32_t* row_totals;  // [rows]
  std::uint32_t columns;      // parts of the capacity; columns beyond the count are never used

  __device__ std::uint32_t& at(std::uint32_t row, std::uint32_t column) const {
    return entries[std::size_t{row} * columns + column];
  }
};

__device__ inline std::uint32_t digit_of(std::uint32_t key, Digit digit) {
  return key >> digit.shift & ((1u << digit.width) - 1);
}

inline std::uint64_t table_bytes(int rows, std::uint32_t columns) {
  return sizeof(std::uint32_t) * static_cast<std::uint64_t>(rows) * (std::uint64_t{columns} + 1);
}

inline DigitTable table_at(void* scratch, int rows, std::uint32_t columns) {
  auto* words = static_cast<std::uint32_t*>(scratch);
  return {words + rows, words, columns};
}

namespace digit_table {

constexpr int kThreads = 1024;

/// Sums up one row per block: each entry becomes the sum of those before it in the row.
static __global__ void __launch_bounds__(kThreads)
    sum_rows_kernel(DigitTable table, const std::uint64_t* count, std::uint32_t capacity,
                    std::uint32_t part_items) {
  __shared__ std::uint32_t warp_sums[kThreads / kWarpThreads];
  const std::uint32_t parts = parts_of(pairs_to_sort(count, capacity), part_items);
  std::uint32_t before = 0;
  for (std::uint32_t first = 0; first < parts; first += kThreads) {
    const std::uint32_t part = first + threadIdx.x;
    const std::uint32_t x = part < parts ? table.at(blockIdx.x, part) : 0;
    const Sums sums = block_sums<kThreads>(x, warp_sums);
    if (part < parts) table.at(blockIdx.x, part) = before + sums.before;
    before += sums.total;
    __syncthreads();  // the next round uses warp_sums again
  }
  if (threadIdx.x == 0) table.row_totals[blockIdx.x] = before;
}

inline void sum_rows(const DigitTable& table, int rows, const Shape& shape, const Call& call,
                     std::uint32_t part_items) {
  sum_rows_kernel<<<rows, kThreads, 0, call.stream>>>(table, call.count, shape.capacity,
                                                      part_items);
  cuda::check(cudaGetLastError());
}

}  // namespace digit_table
}  // namespace octocell::cuda_custom
