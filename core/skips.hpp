// SPDX-License-Identifier: MIT
// Work that a scene may not need. Each skip has a test which proves for the given scene that
// leaving the work out changes no answer. Each skip can be forbidden by name; that changes only the
// time.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/enum_set.hpp"

namespace octocell {

enum class Skip : std::uint8_t {
  search,       // no two spheres may collide, wherever they are: nothing is searched
  grid,         // few spheres: every pair is tested, without cells
  phantoms,     // cells are a diameter wide: one id a sphere; neighbours are visited instead of
                // phantoms
  wide_cells,   // radii differ: large spheres get a level of their own, so small ones keep small
                // cells
  layers,       // flat scenes: there are no rows above and below
  key_bits,     // ids have only as many bits as the grid needs
  safe_filter,  // radii are neither tiny nor huge: the float32 test needs no guards
  equal_radii,  // all radii are equal: the right-hand side of the test is a constant
  uncertain_pairs,  // all numbers lie on a lattice: plain float32 is exact
  sort,             // ids that are already in order are not sorted
  unchanged,   // dynamic: no sphere has changed since the last frame, so its pairs are still right
  few_movers,  // dynamic: only spheres that moved are searched
  skin,        // dynamic: nothing has moved far, so only the neighbor pairs are tested again
};
inline constexpr std::size_t kSkipCount = 13;

struct SkipInfo {
  std::string_view name;
  std::string_view saves;  // what is left out
  std::string_view proof;  // why that is safe
};
inline constexpr std::array<SkipInfo, kSkipCount> kSkips = {{
    {"search", "all stages after bounds",
     "all spheres are static, or no mask names a group of the others, or theirs name no group"},
    {"grid", "cells, ids and their sort", "every pair is tested"},
    {"phantoms", "up to seven more ids a sphere",
     "cells are at least a diameter wide, so spheres that overlap lie in adjacent cells"},
    {"wide_cells", "candidates in cells made for the largest sphere",
     "each level's cells are at least its own diameters wide; levels are tested across"},
    {"layers", "the rows above and below", "all spheres lie in one layer of cells"},
    {"key_bits", "passes over bits that no id has", "ids are below the number of cells"},
    {"safe_filter", "guards against underflow and overflow",
     "every nonzero radius lies in [2^-60, 2^62]"},
    {"equal_radii", "the radius of every candidate", "the smallest radius equals the largest"},
    {"uncertain_pairs", "the filter, and uncertain pairs for stage 6",
     "all numbers are multiples of one power of two with so few bits that nothing is rounded"},
    {"sort", "the sort", "the ids are already in order"},
    {"unchanged", "all work of the frame",
     "every sphere equals, bit for bit, its snapshot of the last frame"},
    {"few_movers", "pairs of spheres that did not move",
     "they equal, bit for bit, the snapshot whose pairs are known"},
    {"skin", "the search, as long as the neighbor list is valid",
     "no sphere is further than half the skin from where it was when the list was made"},
}};
constexpr std::string_view name_of(Skip s) { return kSkips[static_cast<std::size_t>(s)].name; }

/// Returns true if the plan decides about the skip; otherwise the data decide, while the stages
/// run.
constexpr bool is_planned(Skip s) { return s < Skip::sort; }

using Skips = EnumSet<Skip, kSkipCount>;

}  // namespace octocell
