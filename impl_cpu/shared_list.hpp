// SPDX-License-Identifier: MIT
// How many threads write one list. Each thread fills a small block of its own, then reserves that
// much of the list with one atomic addition and copies. (The GPU does the same with one atomic per
// thread block.)
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <utility>

#include "core/buffer.hpp"
#include "impl_cpu/block_size.hpp"

namespace octocell::cpu {

/// A list that many threads append to. Past its end, it continues to count but writes nothing.
template <typename T>
class SharedList {
 public:
  void allocate(std::uint64_t capacity) { items_.allocate(capacity); }
  void clear(std::uint64_t size = 0) { size_.store(size, std::memory_order_relaxed); }

  /// Returns the memory of the items and goes on, empty, with other memory.
  Buffer<T> exchange(Buffer<T> empty) {
    clear();
    return std::exchange(items_, std::move(empty));
  }

  void append(std::span<const T> items) {
    const std::uint64_t at = size_.fetch_add(items.size(), std::memory_order_relaxed);
    if (at + items.size() > items_.capacity()) return;
    std::copy(items.begin(), items.end(), items_.data() + at);
  }

  /// Counts like append(), but stores nothing.
  void count(std::uint64_t items) { size_.fetch_add(items, std::memory_order_relaxed); }

  /// Returns how many items were appended, including those that were not stored.
  [[nodiscard]] std::uint64_t size() const { return size_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool complete() const { return size() <= items_.capacity(); }
  [[nodiscard]] std::span<T> items() const {
    return {items_.data(), complete() ? size() : std::uint64_t{0}};
  }

 private:
  Buffer<T> items_;
  std::atomic<std::uint64_t> size_ = 0;
};

/// How many items a thread appends to a list at a time.
inline constexpr std::size_t kListBlock = block_size(1024, 4);

/// One thread's block. Flushes when it is full and when it is destroyed.
template <typename T, std::size_t kBlock, typename Sink = SharedList<T>>
class ListWriter {
 public:
  explicit ListWriter(Sink& sink) : sink_(sink) {}
  ListWriter(const ListWriter&) = delete;
  ListWriter& operator=(const ListWriter&) = delete;
  ~ListWriter() { flush(); }

  void push(const T& item) {
    if (size_ == kBlock) flush();
    block_[size_++] = item;
  }
  void flush() {
    if (size_ != 0) sink_.append({block_.data(), size_});
    size_ = 0;
  }

 private:
  Sink& sink_;
  std::size_t size_ = 0;
  std::array<T, kBlock> block_;
};

}  // namespace octocell::cpu
