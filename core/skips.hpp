// SPDX-License-Identifier: MIT
// What a scene may not need. Each skip rests on a test that proves, for the scene at hand, that
// leaving the work out changes no answer; each can be forbidden by name, which changes only time.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace octocell {

enum class Skip : std::uint8_t {
  search,       // no two spheres may collide, whatever their places: nothing is looked for
  grid,         // few spheres: every pair is tested, no cells
  phantoms,     // cells are a diameter wide: one id a sphere, neighbours are visited instead
  wide_cells,   // radii differ: the large get a level of their own, so the small keep small cells
  layers,       // flat scenes: no rows above and below
  key_bits,     // ids are no longer than the grid needs
  safe_filter,  // radii are neither tiny nor huge: the float32 test needs no guards
  equal_radii,  // all radii are one: what is compared with is a constant
  uncertain_pairs,  // all numbers lie on a lattice: plain float32 is exact
  passes,           // a digit that all ids share is not sorted by
  sort,             // ids that come in order are not sorted
  unchanged,        // dynamic: no sphere has changed since the last frame: its pairs stand
  few_movers,       // dynamic: only spheres that moved are searched for
  skin,  // dynamic: nothing has moved far: the neighbor pairs are tested again, no others
};
inline constexpr std::size_t kSkipCount = 14;

struct SkipInfo {
  std::string_view name;
  std::string_view saves;  // what is left out
  std::string_view proof;  // why that is safe
};
inline constexpr std::array<SkipInfo, kSkipCount> kSkips = {{
    {"search", "everything behind the bounds",
     "all spheres are static, or no group of one that is not is in any mask, or the reverse"},
    {"grid", "cells, ids and their sort", "every pair is tested"},
    {"phantoms", "up to seven further ids a sphere",
     "cells are at least a diameter wide, so spheres that overlap lie in adjacent ones"},
    {"wide_cells", "candidates in cells made to the measure of the largest sphere",
     "each level's cells are at least its own diameters wide; levels are tested across"},
    {"layers", "the rows above and below", "all spheres lie in one layer of cells"},
    {"key_bits", "passes over bits that no id has", "ids are below the number of cells"},
    {"safe_filter", "guards against underflow and overflow",
     "every nonzero radius lies in [2^-60, 2^62]"},
    {"equal_radii", "the radius of every candidate", "the smallest radius is the largest"},
    {"uncertain_pairs", "the filter, and uncertain pairs for stage 6",
     "all numbers are multiples of one power of two, and so few bits wide that nothing is rounded"},
    {"passes", "passes over a digit that all ids share", "such a pass moves nothing"},
    {"sort", "the sort", "the ids come in order"},
    {"unchanged", "the frame", "every sphere equals, bit for bit, the copy of the last frame"},
    {"few_movers", "pairs of spheres that stand still",
     "they equal, bit for bit, the copy whose pairs are known"},
    {"skin", "the search, while neighbor pairs are known",
     "no sphere is further than half the skin from where the neighbor pairs were found"},
}};
constexpr std::string_view name_of(Skip s) { return kSkips[static_cast<std::size_t>(s)].name; }

/// Whether the plan decides it; else the data do, while the stages run.
constexpr bool is_planned(Skip s) { return s < Skip::passes; }

/// A set of skips.
class Skips {
 public:
  constexpr Skips() = default;
  static constexpr Skips all() { return Skips((1U << kSkipCount) - 1U); }
  [[nodiscard]] constexpr bool has(Skip s) const { return (bits_ & bit(s)) != 0; }
  [[nodiscard]] constexpr Skips with(Skip s) const { return Skips(bits_ | bit(s)); }
  [[nodiscard]] constexpr Skips without(Skip s) const { return Skips(bits_ & ~bit(s)); }
  [[nodiscard]] constexpr Skips both(Skips other) const { return Skips(bits_ & other.bits_); }
  [[nodiscard]] constexpr Skips either(Skips other) const { return Skips(bits_ | other.bits_); }
  friend constexpr bool operator==(Skips, Skips) = default;

 private:
  constexpr explicit Skips(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Skip s) { return 1U << static_cast<std::uint32_t>(s); }
  std::uint32_t bits_ = 0;
};

}  // namespace octocell
