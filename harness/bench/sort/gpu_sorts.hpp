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

/// Why no sort can run on a device here; nothing where one can.
std::optional<std::string> why_no_gpu();

/// The ladder, then CUB.
const std::vector<std::string_view>& gpu_algorithms();

struct GpuDescription {
  std::string name;
  std::string cub_version;
  double copy_gigabytes_per_second;  // read and written: what no sort can be faster than
};
/// Measures the copy, so call it once.
GpuDescription describe_gpu();

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
