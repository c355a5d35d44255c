// SPDX-License-Identifier: MIT
// cub::DeviceRadixSort, the ceiling for stage 3 on the device.
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
  /// Sorts `count` pairs (below 2^31) by keys below 2^bits. Unlike ours, CUB needs to know on the
  /// host how many there are.
  RadixSort(std::uint64_t count, int bits);

  /// What launch() needs at `scratch`. CUB's passes switch between front and back as ours do.
  [[nodiscard]] std::uint64_t scratch_bytes() const { return scratch_bytes_; }

  /// Queues the sort; `front` holds the input. Returns where the result will be: 0 for front, 1
  /// for back.
  int launch(KeysAndValues front, KeysAndValues back, void* scratch, cudaStream_t stream) const;

 private:
  int count_;
  int bits_;
  std::size_t scratch_bytes_ = 0;
};

/// "3.0.1", say.
std::string version();

}  // namespace octocell::cub_baseline
