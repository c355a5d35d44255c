// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace octocell {

/// Memory whose size the plan gives. Its pages are touched only when they are written, so room for
/// the worst case costs nothing until it is needed. Large buffers ask for huge pages: the system
/// hands a first run its memory page by page, and that took a third of the run's time
/// (docs/decisions/0013-huge-pages.md).
template <typename T>
class Buffer {
 public:
  /// Loses the contents if the buffer grows; a smaller or equal capacity changes nothing.
  void allocate(std::uint64_t capacity) {
    if (capacity <= capacity_ && data_) return;
    data_.reset();
    data_.reset(static_cast<T*>(pages_for(capacity * sizeof(T))));
    capacity_ = capacity;
  }
  [[nodiscard]] T* data() const { return data_.get(); }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  /// Gives the memory away, to be freed by std::free().
  [[nodiscard]] T* release() {
    capacity_ = 0;
    return data_.release();
  }
  T& operator[](std::uint64_t i) const { return data_[i]; }

 private:
  struct Free {
    void operator()(T* pages) const { std::free(pages); }
  };
  static void* pages_for(std::uint64_t bytes) {
    constexpr std::uint64_t kHugePage = std::uint64_t{2} << 20;
    const bool large = bytes >= kHugePage;
    const std::uint64_t alignment = large ? kHugePage : 64;
    const std::uint64_t rounded = (bytes + alignment) / alignment * alignment;
    void* const pages = rounded > bytes ? std::aligned_alloc(alignment, rounded) : nullptr;
    if (pages == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    if (large) madvise(pages, rounded, MADV_HUGEPAGE);  // best effort: failure only costs speed
#endif
    return pages;
  }

  std::unique_ptr<T[], Free> data_;
  std::uint64_t capacity_ = 0;
};

}  // namespace octocell
