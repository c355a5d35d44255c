// SPDX-License-Identifier: MIT
#include <optional>
#include <string>

#include "harness/bench/sort/optional_sorts.hpp"

namespace octocell::bench {

Algorithm highway_vqsort() {
  return {.name = "highway_vqsort",
          .stable = false,
          .packed = true,
          .parallel = false,
          .slow = false,
          .create = nullptr,
          .why_missing =
              "built without a Highway that has vqsort (Debian 12, Ubuntu 24.04: "
              "libhwy-dev)"};
}

std::optional<std::string> highway_version() { return std::nullopt; }

}  // namespace octocell::bench
