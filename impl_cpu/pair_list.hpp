// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <utility>

#include "core/pair.hpp"
#include "impl_cpu/shared_list.hpp"

namespace octocell::cpu {

/// The pairs found. A count_only plan only counts them and sums their checksum.
class PairList {
 public:
  void allocate(std::uint64_t capacity) { stored_.allocate(capacity); }
  void clear(bool count_only) {
    count_only_ = count_only;
    stored_.clear();
    count_.store(0, std::memory_order_relaxed);
    checksum_.store(0, std::memory_order_relaxed);
  }

  void append(std::span<const Pair> pairs) {
    if (!count_only_) return stored_.append(pairs);
    const PairDigest digest = digest_of(pairs);
    count_.fetch_add(digest.count, std::memory_order_relaxed);
    checksum_.fetch_add(digest.checksum, std::memory_order_relaxed);
  }

  [[nodiscard]] std::uint64_t size() const {
    if (!count_only_) return stored_.size();
    return count_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::span<const Pair> items() const { return stored_.items(); }
  /// Returns the stored pairs so that the caller can remove some; cut() then sets how many remain.
  [[nodiscard]] std::span<Pair> stored() { return stored_.items(); }
  /// Returns the memory of the stored pairs and goes on, empty, with other memory.
  Buffer<Pair> exchange(Buffer<Pair> empty) { return stored_.exchange(std::move(empty)); }
  void cut(std::uint64_t size) { stored_.clear(size); }
  [[nodiscard]] bool complete() const { return stored_.complete(); }
  [[nodiscard]] PairDigest digest() const {
    if (!count_only_) return digest_of(stored_.items());
    return {size(), checksum_.load(std::memory_order_relaxed)};
  }

 private:
  bool count_only_ = false;
  SharedList<Pair> stored_;
  std::atomic<std::uint64_t> count_ = 0;
  std::atomic<std::uint64_t> checksum_ = 0;
};

/// Appends pairs of one thread, 8 KiB at a time.
using PairWriter = ListWriter<Pair, kListBlock, PairList>;

}  // namespace octocell::cpu
