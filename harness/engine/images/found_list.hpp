// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <mutex>
#include <span>

#include "core/buffer.hpp"
#include "core/pair.hpp"
#include "harness/engine/images/find_images.hpp"
#include "impl_cpu/threads.hpp"

namespace octocell::images {

struct Found {
  Pair pair;
  Shift shift;
  friend constexpr auto operator<=>(const Found&, const Found&) = default;
};

/// A list to which several threads append. It checks that there is memory before it grows.
class FoundList {
 public:
  explicit FoundList(const How& how) : how_(how) {}

  /// Makes room, as far as it may be needed.
  void reserve(std::uint64_t pairs);
  void append(std::span<const Found> some);
  /// Ends the list.
  ImagePairs finish(std::uint64_t spheres, cpu::Threads& threads);

 private:
  void grow(std::uint64_t room, std::uint64_t filled);
  void sort(std::uint64_t spheres, cpu::Threads& threads);

  How how_;
  std::mutex mutex_;
  std::uint64_t count_ = 0;
  Buffer<Pair> pairs_;
  Buffer<Shift> shifts_;
};

}  // namespace octocell::images
