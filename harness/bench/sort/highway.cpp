// SPDX-License-Identifier: MIT
#include <hwy/contrib/sort/vqsort.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/bench/sort/optional_sorts.hpp"
#include "harness/bench/sort/packed_sorter.hpp"

namespace octocell::bench {
namespace {

struct Vqsort {
  void operator()(std::vector<std::uint64_t>& all) const {
    sorter(all.data(), all.size(), hwy::SortAscending());
  }
  hwy::Sorter sorter;  // its buffer is used for many sorts
};

}  // namespace

Algorithm highway_vqsort() {
  return {.name = "highway_vqsort",
          .stable = false,
          .packed = true,
          .parallel = false,
          .slow = false,
          .create = create_packed<Vqsort>};
}

std::optional<std::string> highway_version() { return OCTOCELL_HIGHWAY_VERSION; }

}  // namespace octocell::bench
