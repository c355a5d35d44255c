// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/cuda/cuda.cuh"

namespace octocell::cuda_custom {

/// Host memory that the device can access directly.
template <typename T>
class PinnedArray {
 public:
  PinnedArray() = default;
  PinnedArray(const PinnedArray&) = delete;
  PinnedArray& operator=(const PinnedArray&) = delete;
  ~PinnedArray() { cudaFreeHost(data_); }

  void allocate(std::uint64_t capacity) {
    if (capacity <= capacity_) return;
    cudaFreeHost(data_);
    data_ = nullptr;
    capacity_ = 0;
    cuda::check(cudaMallocHost(&data_, capacity * sizeof(T)));
    capacity_ = capacity;
  }
  [[nodiscard]] T* data() const { return data_; }

 private:
  T* data_ = nullptr;
  std::uint64_t capacity_ = 0;
};

}  // namespace octocell::cuda_custom
