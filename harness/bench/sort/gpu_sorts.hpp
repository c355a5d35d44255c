// SPDX-License-Identifier: MIT
// The sorts on the device, as the benchmark sees them. CMake compiles gpu_sorts.cu, or
// gpu_sorts_missing.cpp where there is no nvcc.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octocell::bench {

/// The ladder, then CUB.
const std::vector<std::string_view>& gpu_algorithms();

std::string cub_version();

struct GpuRun {
  double ms;
  std::optional<std::string> fault;
};

/// One input on the device.
class GpuSortCase {
 public:
  virtual ~GpuSortCase() = default;
  /// Restores the input, sorts it, checks the answer. The time is that of the sort on the device,
  /// between two events; allocation, restoring and checking are outside.
  virtual GpuRun run(std::size_t algorithm) = 0;
};
/// Keys are below 2^bits; values will be 0, 1, 2, ... Throws LimitError if the device is too small.
std::unique_ptr<GpuSortCase> make_gpu_sort_case(const std::vector<std::uint32_t>& keys, int bits);

}  // namespace octocell::bench
