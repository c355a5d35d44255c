// SPDX-License-Identifier: MIT
// The sorts on the GPU, as the benchmark sees them. CMake compiles gpu_sorts.cu; without nvcc,
// gpu_sorts_missing.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octocell::bench {

/// Returns the variants of our sort, then CUB.
const std::vector<std::string_view>& gpu_algorithms();

std::string cub_version();

struct GpuRun {
  double ms;
  std::optional<std::string> fault;
};

/// One input on the GPU.
class GpuSortCase {
 public:
  virtual ~GpuSortCase() = default;
  /// Restores the input, sorts it and checks the answer. Only the sort on the GPU is timed, between
  /// two events; allocating, restoring and checking are not.
  virtual GpuRun run(std::size_t algorithm) = 0;
};
/// Makes a case. Keys must be below 2^bits; values will be 0, 1, 2, ... Throws LimitError if the
/// GPU is too small.
std::unique_ptr<GpuSortCase> make_gpu_sort_case(const std::vector<std::uint32_t>& keys, int bits);

}  // namespace octocell::bench
