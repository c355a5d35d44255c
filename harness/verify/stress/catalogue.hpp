// SPDX-License-Identifier: MIT
// The stress catalogue: scenes on which broad phases were seen to fail, with what is asked of an
// answer. One file per family; catalogue.cpp joins their tables.
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

/// One scene, and what is known of it beforehand.
struct Case {
  std::string name;
  Spheres spheres = {};
  std::optional<std::uint64_t> pair_count = {};  // by a formula, not by the oracle
  std::optional<std::vector<Pair>> pairs = {};   // from another scene's exact pairs
  std::vector<double> cell_sides = {};           // rule lowest_cell is tried with these, too
  std::vector<Spheres> before = {};              // frames, or scenes, that the finder saw first
  std::optional<std::uint32_t> bad_sphere = {};  // the first that is not valid
  std::vector<Flags> flags = {};                 // none, or of every sphere

  [[nodiscard]] SceneView view() const { return {spheres, flags}; }
};

/// What a case asks of an implementation.
enum class Ask : std::uint8_t {
  pairs,         // the exact pairs
  count,         // their number, by formula: too many to store
  refusal,       // an InputError that names the bad sphere
  buffers,       // with room for all pairs, for one less, for none: the size needed
  frames,        // the exact pairs of the last frame, after those before it
  other_scenes,  // the exact pairs, whatever scenes the finder had before
  repetition,    // one checksum over runs and numbers of threads
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
  std::string_view not_run = {};  // why, where it cannot be a scene
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

/// All of them, in this order.
std::vector<Entry> catalogue();

}  // namespace octocell::stress
