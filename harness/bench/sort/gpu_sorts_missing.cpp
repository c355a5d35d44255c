// SPDX-License-Identifier: MIT
#include "harness/bench/sort/gpu_sorts.hpp"
#include "harness/interface/error.hpp"

namespace octocell::bench {

std::optional<std::string> why_no_gpu() { return "built without nvcc"; }

const std::vector<std::string_view>& gpu_algorithms() {
  static const std::vector<std::string_view> none;
  return none;
}

GpuDescription describe_gpu() { throw Error(*why_no_gpu()); }

std::unique_ptr<GpuSortCase> make_gpu_sort_case(const std::vector<std::uint32_t>&, int) {
  throw Error(*why_no_gpu());
}

}  // namespace octocell::bench
