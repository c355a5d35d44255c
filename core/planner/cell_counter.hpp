// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "core/planner/scene_stats.hpp"

namespace octocell {

/// Counts how often each cell id was met. Open addressing, at most a quarter full.
class CellCounter {
 public:
  /// Returns how often the id was met before, and counts this time.
  std::uint32_t count_before(std::uint32_t id) {
    std::size_t slot = id * 2654435761U >> (32 - kBits);  // Knuth's multiplicative hash
    while (slots_[slot].count != 0 && slots_[slot].id != id) slot = (slot + 1) % kSlots;
    slots_[slot].id = id;
    return slots_[slot].count++;
  }

 private:
  static constexpr int kBits = 12;
  static constexpr std::size_t kSlots = std::size_t{1} << kBits;
  static_assert(kSlots >= 4 * kSampleSize);
  struct Slot {
    std::uint32_t id;
    std::uint32_t count;
  };
  std::array<Slot, kSlots> slots_ = {};
};

}  // namespace octocell
