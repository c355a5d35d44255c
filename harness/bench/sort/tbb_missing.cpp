// SPDX-License-Identifier: MIT
#include <optional>
#include <string>

#include "harness/bench/sort/optional_sorts.hpp"

namespace octocell::bench {

Algorithm tbb_parallel_sort() {
  return {.name = "tbb_parallel_sort",
          .stable = false,
          .packed = true,
          .parallel = true,
          .slow = true,
          .create = nullptr,
          .why_missing = "built without oneTBB (Debian and Ubuntu: libtbb-dev)"};
}

std::optional<std::string> tbb_version() { return std::nullopt; }

}  // namespace octocell::bench
