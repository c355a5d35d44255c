// SPDX-License-Identifier: MIT
// A shared library with someone else's broad phase (include/octocell/octocell_plugin.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/sphere.hpp"
#include "include/octocell/octocell_plugin.h"

namespace octocell {

/// Room for pairs, and a red zone behind it that must not change.
class PairRoom {
 public:
  explicit PairRoom(std::uint64_t capacity = 0);
  [[nodiscard]] octocell_pair* data() { return pairs_.data(); }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  [[nodiscard]] bool is_overrun() const;
  [[nodiscard]] std::span<const octocell_pair> first(std::uint64_t count) const {
    return std::span(pairs_).first(count);
  }

 private:
  std::uint64_t capacity_;
  std::vector<octocell_pair> pairs_;
};

class PluginLibrary {
 public:
  /// Loads the library, which stays loaded. Throws InputError if it cannot be loaded or has no
  /// function find_pairs.
  explicit PluginLibrary(const std::string& path);

  /// Call these in this order, for each scene; find() any number of times. They do nothing if the
  /// library has no such function. Throw LimitError if it reports a failure.
  void prepare(std::size_t spheres) const;
  /// Returns the number of pairs. If that is above the room's capacity, the room was too small.
  /// Throws LimitError also for a write behind the room's end.
  std::uint64_t find(std::span<const Sphere> spheres, PairRoom& room) const;
  void finish() const;

 private:
  decltype(find_pairs)* find_ = nullptr;
  decltype(::prepare)* prepare_ = nullptr;
  decltype(::finish)* finish_ = nullptr;
};

}  // namespace octocell
