// SPDX-License-Identifier: MIT
// An array in the GPU's memory that frees itself, and copies to and from the host.
#pragma once

#include <cstdint>
#include <stdexcept>

/// The first error of CUDA's ends the function; `octocell try` shows the text.
inline void check(cudaError_t error) {
  if (error != cudaSuccess) throw std::runtime_error(cudaGetErrorString(error));
}

template <typename T>
class DeviceArray {
 public:
  explicit DeviceArray(std::uint64_t size) { check(cudaMalloc(&data_, (size + 1) * sizeof(T))); }
  DeviceArray(const T* from, std::uint64_t size) : DeviceArray(size) {
    check(cudaMemcpy(data_, from, size * sizeof(T), cudaMemcpyHostToDevice));
  }
  DeviceArray(const DeviceArray&) = delete;
  DeviceArray& operator=(const DeviceArray&) = delete;
  ~DeviceArray() { cudaFree(data_); }

  [[nodiscard]] T* data() const { return data_; }
  void fill_with_zeros(std::uint64_t size) { check(cudaMemset(data_, 0, size * sizeof(T))); }
  void copy_to(T* to, std::uint64_t size) const {
    check(cudaMemcpy(to, data_, size * sizeof(T), cudaMemcpyDeviceToHost));
  }

 private:
  T* data_ = nullptr;
};

/// Enough blocks of 128 threads for n threads; a launch of no blocks is an error.
inline unsigned blocks_for(std::uint64_t n) { return n == 0 ? 1 : unsigned((n + 127) / 128); }
