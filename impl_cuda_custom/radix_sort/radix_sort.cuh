// SPDX-License-Identifier: MIT
// Stable radix sort of 32-bit keys with 32-bit values, on the device. There are four variants, from
// the simplest to the fastest: 1_one_bit_split.cu to 4_onesweep.cu.
#pragma once

#include <cuda_runtime_api.h>

#include <cstdint>
#include <vector>

#include "core/digit_plan.hpp"
#include "core/run_record.hpp"

namespace octocell::cuda_custom {

namespace digit_histograms {
struct HistogramsJob;
}

enum class Variant : std::uint8_t { one_bit_split, digit_passes, reduce_then_scan, onesweep };

/// Two device arrays that are sorted together: one half of a double buffer. Made by arrays_in(),
/// because both are in one piece of memory.
struct KeysAndValues {
  std::uint32_t* keys;
  std::uint32_t* values;
};

/// Returns the words of one side: the keys, then the values. They are in one piece so that between
/// two passes a key can be stored beside its value. Each array is a multiple of 16 bytes, so that
/// values can be read four at a time.
constexpr std::uint64_t words_of_side(std::uint64_t capacity) { return (capacity + 3) / 4 * 8; }

/// Returns the arrays in `memory` of words_of_side(capacity) words, aligned as by cudaMalloc.
constexpr KeysAndValues arrays_in(std::uint32_t* memory, std::uint64_t capacity) {
  return {memory, memory + words_of_side(capacity) / 2};
}

class RadixSort {
 public:
  /// Prepares to sort up to `capacity` pairs (below 2^31) by keys below 2^bits, 0 <= bits <= 32, on
  /// the current device. Throws LimitError for too many pairs, and Error for bits that no key has.
  RadixSort(Variant variant, std::uint64_t capacity, int bits);

  /// Returns how many bytes launch() needs at `scratch`, aligned as by cudaMalloc.
  [[nodiscard]] std::uint64_t scratch_bytes() const;

  /// Returns where launch() leaves the result: 0 for front, 1 for back.
  [[nodiscard]] int result_side() const { return plan_.passes % 2; }

  /// Queues the sort of min(*count, capacity) pairs; `count` is on the device. Neither waits nor
  /// allocates. `front` holds the input; all memory of both sides is overwritten. `passes`, if it
  /// is not null, receives a copy of what each pass counts and writes (which waits; variant
  /// onesweep).
  void launch(KeysAndValues front, KeysAndValues back, const std::uint64_t* count, void* scratch,
              cudaStream_t stream, std::vector<SortPass>* passes = nullptr) const;

  /// launch() in parts, for a kernel that makes the keys and counts their digits at the same time
  /// (digit_histograms.cuh). Clear the first words of `scratch`, run that kernel, then launch the
  /// passes. Needs variant onesweep and keys of at least one bit. If `out_of_order`, on the device,
  /// is zero, the keys are already in order; they are only copied to the side where the result is
  /// expected.
  [[nodiscard]] int passes() const { return plan_.passes; }
  [[nodiscard]] std::uint64_t zeroed_words() const;
  [[nodiscard]] digit_histograms::HistogramsJob histograms(const std::uint64_t* count,
                                                           void* scratch) const;
  void launch_passes(KeysAndValues front, KeysAndValues back, const std::uint64_t* count,
                     const std::uint32_t* out_of_order, void* scratch, cudaStream_t stream,
                     std::vector<SortPass>* passes = nullptr) const;

 private:
  Variant variant_;
  std::uint32_t capacity_;
  DigitPlan plan_;
  int tile_ = 0;  // index into the variant's tile sizes, if it has several
};

}  // namespace octocell::cuda_custom
