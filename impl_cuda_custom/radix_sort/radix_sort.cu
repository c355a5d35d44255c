// SPDX-License-Identifier: MIT
#include "impl_cuda_custom/radix_sort/radix_sort.cuh"

#include <string>

#include "core/error.hpp"
#include "impl_cuda_custom/radix_sort/digit_histograms.cuh"
#include "impl_cuda_custom/radix_sort/variants.cuh"

namespace octocell::cuda_custom {
namespace {

struct VariantCode {
  Shape (*shape)(std::uint32_t capacity, int bits);
  std::uint64_t (*scratch_bytes)(const Shape& shape);
  void (*launch)(const Shape& shape, const Call& call);
};

/// In the order of Variant.
constexpr VariantCode kVariants[] = {
    {one_bit_split::shape, one_bit_split::scratch_bytes, one_bit_split::launch},
    {digit_passes::shape, digit_passes::scratch_bytes, digit_passes::launch},
    {reduce_then_scan::shape, reduce_then_scan::scratch_bytes, reduce_then_scan::launch},
    {onesweep::shape, onesweep::scratch_bytes, onesweep::launch},
};

const VariantCode& code_of(Variant variant) { return kVariants[static_cast<int>(variant)]; }

constexpr std::uint64_t kMostPairs = (std::uint64_t{1} << 31) - 1;

std::uint32_t checked_capacity(std::uint64_t capacity, int bits) {
  if (bits < 0 || bits > 32) throw Error("radix sort: keys of " + std::to_string(bits) + " bits");
  if (capacity > kMostPairs) {
    throw LimitError("radix sort: " + std::to_string(capacity) + " pairs; at most " +
                     std::to_string(kMostPairs));
  }
  return static_cast<std::uint32_t>(capacity);
}

}  // namespace

RadixSort::RadixSort(Variant variant, std::uint64_t capacity, int bits)
    : variant_(variant), capacity_(checked_capacity(capacity, bits)) {
  const Shape shape = code_of(variant).shape(capacity_, bits);
  plan_ = shape.plan;
  tile_ = shape.tile;
}

std::uint64_t RadixSort::scratch_bytes() const {
  if (capacity_ == 0 || plan_.passes == 0) return 0;
  return code_of(variant_).scratch_bytes({capacity_, plan_, tile_});
}

void RadixSort::launch(KeysAndValues front, KeysAndValues back, const std::uint64_t* count,
                       void* scratch, cudaStream_t stream, std::vector<SortPass>* passes) const {
  if (capacity_ == 0 || plan_.passes == 0) return;
  code_of(variant_).launch({capacity_, plan_, tile_},
                           {front, back, count, nullptr, scratch, stream, passes});
}

std::uint64_t RadixSort::zeroed_words() const {
  return onesweep::zeroed_bytes({capacity_, plan_, tile_}) / sizeof(std::uint32_t);
}

digit_histograms::HistogramsJob RadixSort::histograms(const std::uint64_t* count,
                                                      void* scratch) const {
  return onesweep::histograms_of({capacity_, plan_, tile_},
                                 {{}, {}, count, nullptr, scratch, nullptr});
}

void RadixSort::launch_passes(KeysAndValues front, KeysAndValues back, const std::uint64_t* count,
                              const std::uint32_t* out_of_order, void* scratch, cudaStream_t stream,
                              std::vector<SortPass>* passes) const {
  onesweep::launch_passes({capacity_, plan_, tile_},
                          {front, back, count, out_of_order, scratch, stream, passes});
}

}  // namespace octocell::cuda_custom
