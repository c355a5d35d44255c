// SPDX-License-Identifier: MIT
// Stable radix sort of 32-bit keys with 32-bit values, on the device. Four ways, from the simplest
// to the fastest: 1_one_bit_split.cu to 4_onesweep.cu.
#pragma once

#include <cuda_runtime_api.h>

#include <cstdint>

#include "core/digit_plan.hpp"

namespace octocell::cuda_custom {

namespace digit_histograms {
struct Job;
}

enum class Variant : std::uint8_t { one_bit_split, digit_passes, reduce_then_scan, onesweep };

/// Two device arrays that are sorted together: one of the two halves of a double buffer. Made by
/// arrays_in(), since both lie in one piece of memory.
struct KeysAndValues {
  std::uint32_t* keys;
  std::uint32_t* values;
};

/// Memory of a side: the keys, then the values. In one piece, so that between two passes a key may
/// stand there beside its value; each array in steps of 16 bytes, so that values are read by four.
constexpr std::uint64_t words_of_side(std::uint64_t capacity) { return (capacity + 3) / 4 * 8; }

/// The arrays in `memory` of words_of_side(capacity) words, aligned as cudaMalloc does.
constexpr KeysAndValues arrays_in(std::uint32_t* memory, std::uint64_t capacity) {
  return {memory, memory + words_of_side(capacity) / 2};
}

class RadixSort {
 public:
  /// Sorts up to `capacity` pairs (below 2^31) by keys below 2^bits, 0 <= bits <= 32, on the device
  /// that is current. Throws LimitError, or Error for bits that no key has.
  RadixSort(Variant variant, std::uint64_t capacity, int bits);

  /// What launch() needs at `scratch`, aligned as cudaMalloc does.
  [[nodiscard]] std::uint64_t scratch_bytes() const;

  /// Where launch() leaves the result: 0 for front, 1 for back.
  [[nodiscard]] int result_side() const { return plan_.passes % 2; }

  /// Queues the sort of min(*count, capacity) pairs; `count` is on the device. Neither waits nor
  /// allocates. `front` holds the input; all memory of both sides is overwritten.
  void launch(KeysAndValues front, KeysAndValues back, const std::uint64_t* count, void* scratch,
              cudaStream_t stream) const;

  /// launch() in parts, for a kernel that makes the keys and counts their digits while it has them
  /// (digit_histograms.cuh): the first words of `scratch` are zero, that kernel runs, then come the
  /// passes. Variant onesweep, and keys of one bit or more. `out_of_order`, on the device: zero,
  /// and the keys come in order; they are only taken to the side where the result is looked for.
  [[nodiscard]] int passes() const { return plan_.passes; }
  [[nodiscard]] std::uint64_t zeroed_words() const;
  [[nodiscard]] digit_histograms::Job histograms(const std::uint64_t* count, void* scratch) const;
  void launch_passes(KeysAndValues front, KeysAndValues back, const std::uint64_t* count,
                     const std::uint32_t* out_of_order, void* scratch, cudaStream_t stream) const;

 private:
  Variant variant_;
  std::uint32_t capacity_;
  DigitPlan plan_;
  int tile_ = 0;  // which of the variant's tile sizes, where it has several
};

}  // namespace octocell::cuda_custom
