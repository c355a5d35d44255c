// SPDX-License-Identifier: MIT
// Checks on the GPU, without sorting, whether a sort is right.
#pragma once

#include <cstdint>

namespace octocell::bench {

struct SortFaults {
  unsigned long long foreign = 0;     // pairs that are not in the input
  unsigned long long disordered = 0;  // pairs that are not greater than the one before
};

/// The input's values are 0, 1, 2, ..., so it holds the pair (key, value) if input_keys[value] is
/// the key. If also each pair is greater than the one before, first by key, then by value, then no
/// value occurs twice. So without faults the output is the only stable answer.
static __global__ void find_sort_faults_kernel(const std::uint32_t* input_keys,
                                               const std::uint32_t* keys,
                                               const std::uint32_t* values, std::uint32_t count,
                                               SortFaults* faults) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= count) return;
  const std::uint32_t key = keys[i];
  const std::uint32_t value = values[i];
  if (value >= count || input_keys[value] != key) atomicAdd(&faults->foreign, 1ULL);
  if (i == 0) return;
  const bool behind = keys[i - 1] < key || (keys[i - 1] == key && values[i - 1] < value);
  if (!behind) atomicAdd(&faults->disordered, 1ULL);
}

}  // namespace octocell::bench
