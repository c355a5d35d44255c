// SPDX-License-Identifier: MIT
// A copy of what one pass of onesweep has counted and written, for a run that is recorded.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/cuda/cuda.cuh"
#include "core/run_record.hpp"
#include "impl_cuda_custom/radix_sort/onesweep_tile.cuh"

namespace octocell::cuda_custom::onesweep {

template <typename T>
std::vector<T> copy_of(const T* items, std::size_t count, cudaStream_t stream) {
  std::vector<T> copy(count);
  cuda::check(
      cudaMemcpyAsync(copy.data(), items, count * sizeof(T), cudaMemcpyDeviceToHost, stream));
  cuda::check(cudaStreamSynchronize(stream));
  return copy;
}

/// Waits for the pass, which has written its pairs in the form `to`.
inline SortPass copy_of_pass(const Pass& pass, Form to, cudaStream_t stream) {
  const std::uint64_t found = copy_of(pass.count, 1, stream).front();
  const auto size = static_cast<std::uint32_t>(std::min<std::uint64_t>(found, pass.capacity));
  const std::size_t digits = std::size_t{1} << pass.digit.width;
  SortPass copy = {.digit = pass.digit,
                   .counts = {},
                   .offsets = copy_of(pass.starts, digits, stream),
                   .cell_ids = {},
                   .objects = {}};
  for (std::size_t d = 0; d < digits; ++d) {
    copy.counts.push_back((d + 1 < digits ? copy.offsets[d + 1] : size) - copy.offsets[d]);
  }
  if (to == Form::arrays) {
    copy.cell_ids = copy_of(pass.to.keys, size, stream);
    copy.objects = copy_of(pass.to.values, size, stream);
    return copy;
  }
  for (const uint2 pair : copy_of(pairs_of(pass.to), size, stream)) {
    copy.cell_ids.push_back(pair.x);
    copy.objects.push_back(pair.y);
  }
  return copy;
}

}  // namespace octocell::cuda_custom::onesweep
