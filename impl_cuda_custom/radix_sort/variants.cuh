// SPDX-License-Identifier: MIT
// What the file of each variant offers to radix_sort.cu.
#pragma once

#include <cstdint>
#include <vector>

#include "impl_cuda_custom/radix_sort/radix_sort.cuh"

namespace octocell::cuda_custom {

/// What is fixed when a RadixSort is made.
struct Shape {
  std::uint32_t capacity = 0;
  DigitPlan plan;
  int tile = 0;
};

/// The arguments of one launch.
struct Call {
  KeysAndValues front;
  KeysAndValues back;
  const std::uint64_t* count;
  const std::uint32_t* out_of_order;  // or null: not checked
  void* scratch;
  cudaStream_t stream;
  std::vector<SortPass>* passes = nullptr;  // null: not recorded

  [[nodiscard]] KeysAndValues from(int pass) const { return pass % 2 == 0 ? front : back; }
  [[nodiscard]] KeysAndValues to(int pass) const { return pass % 2 == 0 ? back : front; }
};

namespace one_bit_split {
Shape shape(std::uint32_t capacity, int bits);
std::uint64_t scratch_bytes(const Shape& shape);
void launch(const Shape& shape, const Call& call);
}  // namespace one_bit_split

namespace digit_passes {
Shape shape(std::uint32_t capacity, int bits);
std::uint64_t scratch_bytes(const Shape& shape);
void launch(const Shape& shape, const Call& call);
}  // namespace digit_passes

namespace reduce_then_scan {
Shape shape(std::uint32_t capacity, int bits);
std::uint64_t scratch_bytes(const Shape& shape);
void launch(const Shape& shape, const Call& call);
}  // namespace reduce_then_scan

namespace onesweep {
Shape shape(std::uint32_t capacity, int bits);
std::uint64_t scratch_bytes(const Shape& shape);
void launch(const Shape& shape, const Call& call);
// launch() in parts: clear the first bytes of scratch, count digits, run the passes.
std::uint64_t zeroed_bytes(const Shape& shape);
digit_histograms::HistogramsJob histograms_of(const Shape& shape, const Call& call);
void launch_passes(const Shape& shape, const Call& call);
}  // namespace onesweep

}  // namespace octocell::cuda_custom
