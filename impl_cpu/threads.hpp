// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "core/error.hpp"

namespace octocell::cpu {

/// A fixed set of threads, including the caller's (the others take their work from Boost.Asio).
class Threads {
 public:
  /// Starts the threads. If the system does not give that many, there are fewer.
  explicit Threads(int count);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  [[nodiscard]] int asked() const { return asked_; }
  [[nodiscard]] int count() const { return count_; }

  /// Calls task(t) for every t in [0, count()), at the same time; returns when all are done.
  void run(const std::function<void(int)>& task);

  /// Sets what for_blocks() asks before each block of the caller's thread; may be empty. If it
  /// returns true, no more blocks begin, and for_blocks() throws Stopped.
  void stop_when(std::function<bool()> wanted) { stop_wanted_ = std::move(wanted); }

  /// Splits [0, size) into blocks of `block` and calls work(begin, end) for each on the next idle
  /// thread.
  template <typename Work>
  void for_blocks(std::uint64_t size, std::uint64_t block, const Work& work) {
    std::atomic<std::uint64_t> next = 0;
    std::atomic<bool> stopped = false;
    const auto take_blocks = [&](int t) {
      for (;;) {
        if (t == 0 && stop_wanted_ && stop_wanted_()) stopped = true;
        if (stopped.load(std::memory_order_relaxed)) return;
        const std::uint64_t begin = next.fetch_add(block, std::memory_order_relaxed);
        if (begin >= size) return;
        work(begin, std::min(begin + block, size));
      }
    };
    size <= block ? take_blocks(0) : run(take_blocks);
    if (stopped) throw Stopped();
  }

  /// Returns true if holds(begin, end) is true for each block. After the first false, calls it no
  /// more.
  template <typename Holds>
  bool for_all_blocks(std::uint64_t size, std::uint64_t block, const Holds& holds) {
    std::atomic<bool> all = true;
    for_blocks(size, block, [&](std::uint64_t begin, std::uint64_t end) {
      if (all.load(std::memory_order_relaxed) && !holds(begin, end)) all = false;
    });
    return all;
  }

 private:
  struct Pool;
  int asked_;
  std::unique_ptr<Pool> pool_;  // none for one thread
  int count_;
  std::function<bool()> stop_wanted_;
};

}  // namespace octocell::cpu
