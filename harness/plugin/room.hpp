// SPDX-License-Identifier: MIT
// Memory that someone else's function writes, with red zones around it that must not change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace octocell {

template <typename T>
class Room {
 public:
  explicit Room(std::uint64_t capacity = 0)
      : capacity_(capacity), items_(kRedZone + capacity + kRedZone) {
    std::memset(static_cast<void*>(items_.data()), kUnwritten, items_.size() * sizeof(T));
  }
  [[nodiscard]] T* data() { return items_.data() + kRedZone; }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  [[nodiscard]] bool is_overrun() const {
    return !is_unwritten(items_.data() + kRedZone + capacity_);
  }
  [[nodiscard]] bool is_underrun() const { return !is_unwritten(items_.data()); }
  [[nodiscard]] std::span<const T> first(std::uint64_t count) const {
    return std::span(items_).subspan(kRedZone, count);
  }

 private:
  static constexpr std::size_t kRedZone = 1024;
  static constexpr int kUnwritten = 0xf1;

  static bool is_unwritten(const T* zone) {
    const auto bytes = std::as_bytes(std::span(zone, kRedZone));
    return std::ranges::all_of(bytes, [](std::byte b) { return b == std::byte{kUnwritten}; });
  }

  std::uint64_t capacity_;
  std::vector<T> items_;
};

}  // namespace octocell
