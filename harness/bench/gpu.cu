// SPDX-License-Identifier: MIT
#include <algorithm>

#include "core/cuda/cuda.cuh"
#include "harness/bench/gpu.hpp"

namespace octocell::bench {
namespace {

/// Returns the rate of the fastest of several copies of a block that fits into no cache.
double copy_gigabytes_per_second() {
  constexpr std::size_t kBytes = std::size_t{1} << 30;
  cuda::DeviceArray<char> from;
  cuda::DeviceArray<char> to;
  from.allocate(kBytes);
  to.allocate(kBytes);
  cuda::check(cudaMemset(from.data(), 1, kBytes));
  cuda::EventClock clock(nullptr, Marks::off);
  double best_ms = 1e9;
  for (int repetition = 0; repetition < 10; ++repetition) {
    clock.start();
    cuda::check(cudaMemcpyAsync(to.data(), from.data(), kBytes, cudaMemcpyDeviceToDevice, nullptr));
    best_ms = std::min(best_ms, clock.stop().total_ms);
  }
  return 2.0 * kBytes / (best_ms * 1e6);
}

}  // namespace

std::optional<std::string> why_no_gpu() { return cuda::why_no_device(); }

Gpu describe_gpu() {
  int device = 0;
  int version = 0;
  cudaDeviceProp properties;
  cuda::check(cudaGetDevice(&device));
  cuda::check(cudaGetDeviceProperties(&properties, device));
  cuda::check(cudaDriverGetVersion(&version));
  return {properties.name,
          std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10),
          copy_gigabytes_per_second()};
}

}  // namespace octocell::bench
