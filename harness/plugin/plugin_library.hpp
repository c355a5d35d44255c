// SPDX-License-Identifier: MIT
// A shared library with someone else's broad phase (include/octocell/octocell_plugin.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/sphere.hpp"
#include "harness/plugin/room.hpp"
#include "include/octocell/octocell_plugin.h"

namespace octocell {

using PairRoom = Room<octocell_pair>;

/// Loads a shared library, which stays loaded. Throws InputError if it cannot be loaded.
class SharedLibrary {
 public:
  explicit SharedLibrary(const std::string& path);
  /// Returns the function of that name; null if there is none.
  template <typename Function>
  [[nodiscard]] Function* function(const char* name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }

 private:
  [[nodiscard]] void* symbol(const char* name) const;
  void* library_;
};

[[noreturn]] void refuse_overrun(std::string_view list, std::string_view where,
                                 std::uint64_t capacity);
/// Throws LimitError for a code that is not 0.
void require_success(std::string_view function, int code);
/// Throws LimitError if a red zone was written. `list` is how the header names the memory.
template <typename T>
void require_red_zones(const Room<T>& room, std::string_view list) {
  if (room.is_overrun()) refuse_overrun(list, "behind the end", room.capacity());
  if (room.is_underrun()) refuse_overrun(list, "before the beginning", room.capacity());
}

class PluginLibrary {
 public:
  /// Loads the library, which stays loaded. Throws InputError if it cannot be loaded or has no
  /// function find_pairs.
  explicit PluginLibrary(const std::string& path);

  /// Call these in this order, for each scene; find() any number of times. They do nothing if the
  /// library has no such function. Throw LimitError if it reports a failure.
  void prepare(std::size_t spheres) const;
  /// Returns the number of pairs. If that is above the room's capacity, the room was too small.
  /// Throws LimitError also for a write around the room.
  std::uint64_t find(std::span<const Sphere> spheres, PairRoom& room) const;
  /// Does the same for memory with red zones of the caller's own.
  std::uint64_t find_into(std::span<const Sphere> spheres, octocell_pair* pairs,
                          std::uint64_t capacity) const;
  void finish() const;

 private:
  decltype(find_pairs)* find_ = nullptr;
  decltype(::prepare)* prepare_ = nullptr;
  decltype(::finish)* finish_ = nullptr;
};

}  // namespace octocell
