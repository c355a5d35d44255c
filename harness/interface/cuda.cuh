// SPDX-License-Identifier: MIT
// Calls of the CUDA runtime, and what happens when one fails; device memory. Empty without nvcc.
#pragma once

#ifdef __CUDACC__

#include <cuda_runtime_api.h>

#include <cstdint>
#include <source_location>
#include <string>

#include "harness/interface/error.hpp"

namespace octocell::cuda {

/// Throws Error with CUDA's words and the place of the call.
inline void check(cudaError_t result,
                  const std::source_location& place = std::source_location::current()) {
  if (result == cudaSuccess) return;
  cudaGetLastError();  // the next call starts clean, where the device can still be used
  throw Error(std::string("CUDA: ") + cudaGetErrorString(result) + " (" + place.file_name() + ":" +
              std::to_string(place.line()) + ")");
}

struct Memory {
  /// Throws LimitError that says how much was asked for.
  static char* allocate(std::size_t bytes) {
    void* memory = nullptr;
    const cudaError_t result = cudaMalloc(&memory, bytes);
    if (result == cudaErrorMemoryAllocation) {
      cudaGetLastError();
      throw LimitError("the GPU has no " + std::to_string(bytes >> 20) + " MiB left");
    }
    check(result);
    return static_cast<char*>(memory);
  }
  static void release(char* memory) { cudaFree(memory); }
};

/// Memory on the device, of the plan's size. As Buffer: contents are lost when it grows.
template <typename T>
class DeviceArray {
 public:
  DeviceArray() = default;
  DeviceArray(const DeviceArray&) = delete;
  DeviceArray& operator=(const DeviceArray&) = delete;
  ~DeviceArray() { release(); }

  void allocate(std::uint64_t capacity) {
    if (capacity <= capacity_) return;
    release();
    data_ = reinterpret_cast<T*>(Memory::allocate(capacity * sizeof(T)));
    capacity_ = capacity;
  }
  [[nodiscard]] T* data() const { return data_; }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }

 private:
  void release() {
    if (data_ != nullptr) Memory::release(reinterpret_cast<char*>(data_));
    data_ = nullptr;
    capacity_ = 0;
  }

  T* data_ = nullptr;
  std::uint64_t capacity_ = 0;
};

}  // namespace octocell::cuda

#endif
