// SPDX-License-Identifier: MIT
// A shared library with someone else's version of one stage (include/octocell/octocell_stage.h).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/sphere.hpp"
#include "harness/plugin/room.hpp"
#include "include/octocell/octocell_stage.h"

namespace octocell {

/// Cell ids with their objects.
struct EntryView {
  std::span<const std::uint32_t> ids;
  std::span<const std::uint32_t> objects;
};
struct EntryRoom {
  explicit EntryRoom(std::uint64_t capacity) : ids(capacity), objects(capacity) {}
  Room<std::uint32_t> ids;
  Room<std::uint32_t> objects;
};

class StageLibrary {
 public:
  /// Loads the library, which stays loaded. Throws InputError if it cannot be loaded or has no
  /// function of the stage's name.
  StageLibrary(const std::string& path, const std::string& stage);

  /// Each calls the function of its stage. Those that write a list return how many entries it has;
  /// above the room's capacity, the room was too small. Throw LimitError if the function reports a
  /// failure or wrote around the room.
  std::uint64_t cell_ids(std::span<const Sphere> spheres, const octocell_grid& grid,
                         EntryRoom& room) const;
  void sort(EntryView entries, std::uint32_t key_bits, EntryRoom& room) const;
  std::uint64_t cell_index(EntryView sorted, Room<octocell_cell>& room) const;
  std::uint64_t pair_tests(std::span<const Sphere> spheres, EntryView sorted,
                           std::span<const octocell_cell> cells, Room<octocell_pair>& room) const;

 private:
  template <typename Function>
  [[nodiscard]] Function* as() const {
    return reinterpret_cast<Function*>(function_);
  }
  void (*function_)() = nullptr;
};

}  // namespace octocell
