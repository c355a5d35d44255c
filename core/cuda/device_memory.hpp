// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

namespace octocell {

/// Counts how much device memory this program holds, and the most it has held since forget_peak().
class DeviceMemory {
 public:
  [[nodiscard]] static std::uint64_t in_use() { return in_use_.load(); }
  [[nodiscard]] static std::uint64_t peak() { return peak_.load(); }
  static void forget_peak() { peak_.store(in_use()); }

  static void add(std::uint64_t bytes) {
    const std::uint64_t now = in_use_.fetch_add(bytes) + bytes;
    std::uint64_t peak = peak_.load();
    while (peak < now && !peak_.compare_exchange_weak(peak, now)) {
    }
  }
  static void remove(std::uint64_t bytes) { in_use_.fetch_sub(bytes); }

 private:
  inline static std::atomic<std::uint64_t> in_use_ = 0;
  inline static std::atomic<std::uint64_t> peak_ = 0;
};

}  // namespace octocell
