// SPDX-License-Identifier: MIT
#include "baselines/cub/radix_sort.cuh"

#include <cub/device/device_radix_sort.cuh>
#include <cub/version.cuh>

#include "core/cuda/cuda.cuh"

namespace octocell::cub_baseline {
namespace {

using Column = cub::DoubleBuffer<std::uint32_t>;

}  // namespace

RadixSort::RadixSort(std::uint64_t count, int bits) : count_(static_cast<int>(count)), bits_(bits) {
  if (count >> 31 != 0) throw LimitError("CUB: " + std::to_string(count) + " pairs");
  Column keys;
  Column values;
  cuda::check(
      cub::DeviceRadixSort::SortPairs(nullptr, scratch_bytes_, keys, values, count_, 0, bits_));
}

int RadixSort::launch(KeysAndValues front, KeysAndValues back, void* scratch,
                      cudaStream_t stream) const {
  Column keys(front.keys, back.keys);
  Column values(front.values, back.values);
  std::size_t bytes = scratch_bytes_;
  cuda::check(
      cub::DeviceRadixSort::SortPairs(scratch, bytes, keys, values, count_, 0, bits_, stream));
  return keys.selector;
}

std::string version() {
  return std::to_string(CUB_MAJOR_VERSION) + "." + std::to_string(CUB_MINOR_VERSION) + "." +
         std::to_string(CUB_SUBMINOR_VERSION);
}

}  // namespace octocell::cub_baseline
