// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "harness/bench/sort/optional_sorts.hpp"
#include "harness/bench/sort/packed_sorter.hpp"

namespace octocell::bench {
namespace {

class TbbParallelSort final : public Sorter {
 public:
  explicit TbbParallelSort(int threads) : arena_(threads) {
    // The arena requests threads; the control allows more of them than there are cores.
    if (threads > 1) allowed_.emplace(Control::max_allowed_parallelism, threads);
  }

  const PairArrays& sort(Workspace& work, int) override {
    const tbb::blocked_range<std::size_t> all(0, work.packed.size(), kBlock);
    arena_.execute([&] {
      tbb::parallel_for(all, [&](const auto& part) { pack(work, part.begin(), part.end()); });
      tbb::parallel_sort(work.packed.begin(), work.packed.end());
      tbb::parallel_for(all, [&](const auto& part) { unpack(work, part.begin(), part.end()); });
    });
    return work.front;
  }

 private:
  using Control = tbb::global_control;
  static constexpr std::size_t kBlock = 1 << 14;

  std::optional<Control> allowed_;
  tbb::task_arena arena_;
};

std::unique_ptr<Sorter> create(int threads) { return std::make_unique<TbbParallelSort>(threads); }

}  // namespace

Algorithm tbb_parallel_sort() {
  return {.name = "tbb_parallel_sort",
          .stable = false,
          .packed = true,
          .parallel = true,
          .slow = true,
          .create = create};
}

std::optional<std::string> tbb_version() {
  return fmt::format("{}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR);
}

}  // namespace octocell::bench
