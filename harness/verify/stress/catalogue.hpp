// SPDX-License-Identifier: MIT
// The stress catalogue: scenes on which broad phases failed, and what each answer must fulfil.
// There is one file per family; catalogue.cpp joins their tables.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pair.hpp"
#include "core/sphere.hpp"

namespace octocell::stress {

using Spheres = std::vector<Sphere>;

/// One scene, and what is known about it beforehand.
struct Case {
  std::string name;
  Spheres spheres = {};
  std::optional<std::uint64_t> pair_count = {};  // known from a formula, not from the reference
  std::optional<std::vector<Pair>> pairs = {};   // known from another scene's exact pairs
  std::vector<double> cell_sides = {};           // rule lowest_cell is also tried with these
  std::vector<Spheres> before = {};  // frames, or scenes, that the finder searched before
  std::optional<std::uint32_t> bad_sphere = {};  // the first invalid sphere
  std::vector<Flags> flags = {};                 // of every sphere, or empty

  [[nodiscard]] SceneView view() const { return {spheres, flags}; }
};

/// What a case requires of an implementation.
enum class Ask : std::uint8_t {
  pairs,         // the exact pairs
  count,         // their number, by formula: too many to store
  refusal,       // an InputError that names the invalid sphere
  buffers,       // with room for all pairs, for one less, and for none: the required size
  frames,        // the exact pairs of the last frame, after the frames before it
  other_scenes,  // the exact pairs, whatever scenes the finder searched before
  repetition,    // the same checksum in all runs and for all numbers of threads
};

/// About how many spheres: for `make test`, for minutes, for hours. 0: the entry is left out.
struct Sizes {
  std::size_t slice;
  std::size_t quick;
  std::size_t full;
};
enum class Size : std::uint8_t { slice, quick, full };

struct Entry {
  std::string_view id;  // family and number: "A1"
  std::string_view name;
  Sizes sizes = {};
  std::vector<Case> (*cases)(std::size_t n) = nullptr;
  Ask ask = Ask::pairs;
  std::string_view not_run = {};  // why it cannot be a scene, if it cannot
  [[nodiscard]] std::size_t at(Size size) const {
    return size == Size::slice ? sizes.slice : size == Size::quick ? sizes.quick : sizes.full;
  }
};

std::span<const Entry> ties();
std::span<const Entry> cell_borders();
std::span<const Entry> range();
std::span<const Entry> size_distribution();
std::span<const Entry> concentration();
std::span<const Entry> capacity();
std::span<const Entry> dynamics();
std::span<const Entry> determinism();
std::span<const Entry> metamorphic();
std::span<const Entry> real();

/// Returns all entries, in this order.
std::vector<Entry> catalogue();

}  // namespace octocell::stress
