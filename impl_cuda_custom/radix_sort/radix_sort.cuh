// SPDX-License-Identifier: MIT
#pragma once

#include <cuda_runtime_api.h>

#include <cstdint>

namespace octocell::cuda_custom {

/// The ladder: each rung is a whole sort, and faster than the one before.
enum class Rung : std::uint8_t { one_bit_split, digit_passes, reduce_then_scan, onesweep };

/// Two arrays of equal length that are sorted together.
struct KeysAndValues {
  std::uint32_t* keys;
  std::uint32_t* values;
};

/// Stable sort of (key, value) by the lowest `bits` bits of the key, queued on a stream.
class RadixSort {
 public:
  RadixSort(Rung rung, std::uint64_t capacity, int bits);

  /// What launch() needs besides the arrays.
  [[nodiscard]] std::uint64_t scratch_bytes() const;
  /// Which of the two holds the result: 0 front, 1 back.
  [[nodiscard]] int result_side() const;

  /// `front` holds the input; both have room for `capacity`. `count` lies on the device; at most
  /// `capacity` are sorted.
  void launch(KeysAndValues front, KeysAndValues back, const std::uint64_t* count, void* scratch,
              cudaStream_t stream) const;

 private:
  Rung rung_;
  std::uint64_t capacity_;
  int bits_;
};

}  // namespace octocell::cuda_custom
