// SPDX-License-Identifier: MIT
// Method tiles: one cell a sphere; adjacent cells are compared in the tile of the lower one.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "harness/trace/why_rules.hpp"

namespace octocell::trace {
namespace {

Cell list(ListedSphere& s, const Grid& grid) {
  const Cell cell = cell_of(grid, s.sphere.x, s.sphere.y, s.sphere.z);
  s.cells.push_back({cell, cell_id(grid, cell), true});
  s.cell_count = 1;
  return cell;
}

bool are_adjacent(std::uint32_t a, std::uint32_t b) { return a <= b + 1 && b <= a + 1; }

}  // namespace

void meet_in_tiles(Account& account, const Plan& plan) {
  const Tiles& tiles = plan.tiles;
  account.cells = fmt::format("cells of side {:g} in {} x {} x {} tiles", tiles.grid.cell_side,
                              tiles.count[0], tiles.count[1], tiles.count[2]);
  const Cell a = list(account.i, tiles.grid);
  const Cell b = list(account.j, tiles.grid);
  const Cell lowest = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  const bool tested = are_adjacent(a.x, b.x) && are_adjacent(a.y, b.y) && are_adjacent(a.z, b.z);
  Meeting m = {.cell = lowest,
               .id = tiles_met(tiles, lowest).own,
               .home_of_i = a.x == lowest.x && a.y == lowest.y && a.z == lowest.z,
               .home_of_j = b.x == lowest.x && b.y == lowest.y && b.z == lowest.z,
               .tested = tested,
               .reason = tested ? "the cells are adjacent, and this is the lowest that both meet; "
                                  "the id is that of its tile"
                                : "the cells are not adjacent"};
  account.meeting_count = account.test_count = tested ? 1 : 0;
  account.meetings.push_back(std::move(m));
}

}  // namespace octocell::trace
