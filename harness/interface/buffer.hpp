// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

namespace octocell {

/// Memory of the plan's size whose pages are touched only when they are written, so that room for
/// the worst case costs nothing until it is needed.
template <typename T>
class Buffer {
 public:
  /// Contents are lost when it grows; a smaller or equal capacity changes nothing.
  void allocate(std::uint64_t capacity) {
    if (capacity <= capacity_ && data_) return;
    data_.reset();
    data_ = std::make_unique_for_overwrite<T[]>(capacity);
    capacity_ = capacity;
  }
  [[nodiscard]] T* data() const { return data_.get(); }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  T& operator[](std::uint64_t i) const { return data_[i]; }

 private:
  std::unique_ptr<T[]> data_;
  std::uint64_t capacity_ = 0;
};

}  // namespace octocell
