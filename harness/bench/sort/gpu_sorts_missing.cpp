// SPDX-License-Identifier: MIT
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "harness/bench/gpu.hpp"
#include "harness/bench/sort/gpu_sorts.hpp"

namespace octocell::bench {

const std::vector<std::string_view>& gpu_algorithms() {
  static const std::vector<std::string_view> none;
  return none;
}

std::string cub_version() { return {}; }

std::unique_ptr<GpuSortCase> make_gpu_sort_case(const std::vector<std::uint32_t>&, int) {
  throw Error(*why_no_gpu());
}

}  // namespace octocell::bench
