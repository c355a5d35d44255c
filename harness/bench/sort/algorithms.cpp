// SPDX-License-Identifier: MIT
#include "harness/bench/sort/algorithms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/sort/spreadsort/integer_sort.hpp>
#include <boost/version.hpp>

#include "harness/bench/sort/optional_sorts.hpp"
#include "harness/bench/sort/packed_sorter.hpp"
#include "impl_cpu/radix_sort.hpp"

namespace octocell::bench {
namespace {

cpu::KeysAndValues spans_of(PairArrays& pairs) { return {pairs.keys, pairs.values}; }

class OurRadixSort final : public Sorter {
 public:
  explicit OurRadixSort(int threads) : threads_(threads) {}
  const PairArrays& sort(Workspace& work, int bits) override {
    const int where = cpu::radix_sort(spans_of(work.front), spans_of(work.back), bits, threads_);
    return where == 0 ? work.front : work.back;
  }

 private:
  cpu::Threads threads_;
};

std::unique_ptr<Sorter> create_ours(int threads) { return std::make_unique<OurRadixSort>(threads); }

struct StdSort {
  void operator()(std::vector<std::uint64_t>& all) const { std::sort(all.begin(), all.end()); }
};

/// Compares only keys: a stable sort needs no help from the value.
struct StdStableSort {
  void operator()(std::vector<std::uint64_t>& all) const {
    std::stable_sort(all.begin(), all.end(),
                     [](std::uint64_t a, std::uint64_t b) { return a >> 32 < b >> 32; });
  }
};

struct BoostSpreadsort {
  void operator()(std::vector<std::uint64_t>& all) const {
    boost::sort::spreadsort::integer_sort(all.begin(), all.end());
  }
};

}  // namespace

const std::vector<Algorithm>& sort_algorithms() {
  static const std::vector<Algorithm> all = {
      {.name = "impl_cpu",
       .stable = true,
       .packed = false,
       .parallel = true,
       .slow = false,
       .create = create_ours},
      {.name = "std_sort",
       .stable = false,
       .packed = true,
       .parallel = false,
       .slow = true,
       .create = create_packed<StdSort>},
      {.name = "std_stable_sort",
       .stable = true,
       .packed = true,
       .parallel = false,
       .slow = true,
       .create = create_packed<StdStableSort>},
      tbb_parallel_sort(),
      highway_vqsort(),
      {.name = "boost_spreadsort",
       .stable = false,
       .packed = true,
       .parallel = false,
       .slow = false,
       .create = create_packed<BoostSpreadsort>},
  };
  return all;
}

std::vector<LibraryVersion> sort_libraries() {
  const std::string boost = fmt::format("{}.{}.{}", BOOST_VERSION / 100000,
                                        BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
  return {{"boost", boost}, {"tbb", tbb_version()}, {"highway", highway_version()}};
}

}  // namespace octocell::bench
