// SPDX-License-Identifier: MIT
#include "harness/verify/near_tangent/near_tangent.hpp"

#ifdef __CUDACC__

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/cuda/cuda.cuh"

namespace octocell::near_tangent {
namespace {

constexpr int kThreads = 256;
constexpr int kBlocks = 2048;

__global__ void __launch_bounds__(kThreads)
    trial_kernel(Family family, std::uint64_t begin, std::uint64_t end, Tally* tallies) {
  const std::uint64_t t = std::uint64_t{blockIdx.x} * kThreads + threadIdx.x;
  tallies[t] = try_pairs(family, begin + t, end, std::uint64_t{kBlocks} * kThreads);
}

}  // namespace

std::optional<std::string> why_no_device() { return cuda::why_no_device(); }

Tally try_on_device(Family family, std::uint64_t begin, std::uint64_t end) {
  cuda::DeviceArray<Tally> tallies;
  tallies.allocate(kBlocks * kThreads);
  trial_kernel<<<kBlocks, kThreads>>>(family, begin, end, tallies.data());
  cuda::check_launch();
  std::vector<Tally> all(kBlocks * kThreads);
  cuda::check(
      cudaMemcpy(all.data(), tallies.data(), all.size() * sizeof(Tally), cudaMemcpyDeviceToHost));
  Tally sum;
  for (const Tally& tally : all) add(sum, tally);
  return sum;
}

}  // namespace octocell::near_tangent

#else

#include "core/error.hpp"

namespace octocell::near_tangent {

std::optional<std::string> why_no_device() { return "built without nvcc"; }
Tally try_on_device(Family, std::uint64_t, std::uint64_t) { throw Error(*why_no_device()); }

}  // namespace octocell::near_tangent

#endif
