// SPDX-License-Identifier: MIT
// Memory that the judge shares with the process of a hand-in while it is timed: spheres to read,
// pairs to write. So no pipe is part of the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/sphere.hpp"
#include "include/octocell/octocell_plugin.h"

namespace octocell::hand_in {

/// The descriptors of the two memories in the process of a hand-in.
inline constexpr int kSpheresMemory = 5;
inline constexpr int kPairsMemory = 6;

/// In the memory of pairs: the count, a red zone, the list, a red zone.
inline constexpr std::size_t kRedZoneBytes = 65536;
inline constexpr std::size_t kListAt = 4096 + kRedZoneBytes;
inline constexpr std::byte kUnwrittenByte{0xf1};

/// The judge's side.
class Board {
 public:
  Board(std::size_t most_spheres, std::size_t most_pairs);
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  ~Board();

  [[nodiscard]] int spheres_fd() const { return spheres_fd_; }
  [[nodiscard]] int pairs_fd() const { return pairs_fd_; }

  /// Shows the spheres and wipes the pairs.
  void set(std::span<const Sphere> spheres, std::uint64_t capacity);
  [[nodiscard]] std::uint64_t count() const;
  /// Returns pairs that were written.
  [[nodiscard]] std::span<const octocell_pair> first(std::uint64_t count) const;
  [[nodiscard]] bool red_zones_are_whole() const;
  [[nodiscard]] bool holds(std::span<const Sphere> spheres) const;

 private:
  [[nodiscard]] std::size_t pairs_bytes() const;

  std::size_t most_spheres_;
  std::size_t most_pairs_;
  std::uint64_t capacity_ = 0;
  int spheres_fd_;
  int pairs_fd_;
  std::byte* spheres_;
  std::byte* pairs_;
};

/// The hand-in's side. Its spheres can only be read: writing to them is a crash.
struct SeenBoard {
  SeenBoard();
  const octocell_sphere* spheres;
  std::uint64_t* count;
  octocell_pair* pairs;
};

}  // namespace octocell::hand_in
