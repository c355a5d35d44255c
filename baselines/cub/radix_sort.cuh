// SPDX-License-Identifier: MIT
// cub::DeviceRadixSort, the standard to compare our stage 3 on the GPU with.
#pragma once

#include <cuda_runtime_api.h>

#include <cstdint>
#include <string>

namespace octocell::cub_baseline {

/// Two device arrays of equal length that are sorted together.
struct KeysAndValues {
  std::uint32_t* keys;
  std::uint32_t* values;
};

class RadixSort {
 public:
  /// Prepares to sort `count` pairs (below 2^31) by keys below 2^bits. Unlike our sorts, CUB must
  /// know the number of pairs on the host.
  RadixSort(std::uint64_t count, int bits);

  /// Returns how many bytes launch() needs at `scratch`. CUB's passes switch between front and
  /// back, like ours.
  [[nodiscard]] std::uint64_t scratch_bytes() const { return scratch_bytes_; }

  /// Queues the sort; `front` holds the input. Returns where the result will be: 0 for front, 1 for
  /// back.
  int launch(KeysAndValues front, KeysAndValues back, void* scratch, cudaStream_t stream) const;

 private:
  int count_;
  int bits_;
  std::size_t scratch_bytes_ = 0;
};

/// Returns the version, such as "3.0.1".
std::string version();

}  // namespace octocell::cub_baseline
