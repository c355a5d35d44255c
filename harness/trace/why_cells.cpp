// SPDX-License-Identifier: MIT
// Rules lowest_cell and chapter32: a sphere is listed in the cells that its box meets.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "core/chapter32.hpp"
#include "harness/trace/why_rules.hpp"

namespace octocell::trace {
namespace {

bool is_same(Cell a, Cell b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

template <typename Use>
void for_each_cell(const CellRange& range, Use use) {
  for (std::uint32_t z = range.lowest.z; z <= range.highest.z; ++z) {
    for (std::uint32_t y = range.lowest.y; y <= range.highest.y; ++y) {
      for (std::uint32_t x = range.lowest.x; x <= range.highest.x; ++x) {
        if (!use(Cell{x, y, z})) return;
      }
    }
  }
}

struct Place {
  Cell home;
  CellRange met;
};

Place list(ListedSphere& s, const Plan& plan) {
  const bool scaled = plan.rule == Rule::chapter32;
  const float extent = scaled ? chapter32::extent(s.sphere.r) : s.sphere.r;
  const Place place = {cell_of(plan.grid, s.sphere.x, s.sphere.y, s.sphere.z),
                       cells_met(plan.grid, s.sphere, extent)};
  s.cell_count = phantoms_in(place.met) + 1;
  s.cells.push_back({place.home, cell_id(plan.grid, place.home), true});
  for_each_cell(place.met, [&](Cell cell) {
    if (!is_same(cell, place.home)) s.cells.push_back({cell, cell_id(plan.grid, cell), false});
    return s.cells.size() < kMostShown;
  });
  return place;
}

/// The cells of both ranges; none if the highest is below the lowest on some axis.
CellRange common(const CellRange& a, const CellRange& b) {
  return {{std::max(a.lowest.x, b.lowest.x), std::max(a.lowest.y, b.lowest.y),
           std::max(a.lowest.z, b.lowest.z)},
          {std::min(a.highest.x, b.highest.x), std::min(a.highest.y, b.highest.y),
           std::min(a.highest.z, b.highest.z)}};
}

bool is_empty(const CellRange& r) {
  return r.highest.x < r.lowest.x || r.highest.y < r.lowest.y || r.highest.z < r.lowest.z;
}

void judge_lowest(Meeting& m, const CellRange& shared) {
  m.tested = is_same(m.cell, shared.lowest);
  m.reason = m.tested ? "the lowest cell that both meet: the pair counts here"
                      : "not the lowest cell that both meet";
}

void judge_chapter32(Meeting& m, const Place& a, const Place& b) {
  if (!m.home_of_i && !m.home_of_j) {
    m.reason = "both are phantoms here; another cell is the home of one and holds the other";
    return;
  }
  const std::uint32_t type = chapter32::cell_type(m.cell);
  const chapter32::ControlBits i = chapter32::control_bits_of(a.met, a.home);
  const chapter32::ControlBits j = chapter32::control_bits_of(b.met, b.home);
  m.tested = chapter32::tests_pair_here(type, i, j);
  m.reason = m.tested ? fmt::format("type {}: no home of lower type holds both", type)
                      : fmt::format("type {}: a home of lower type holds both", type);
}

}  // namespace

void meet_in_cells(Account& account, const Plan& plan) {
  const Grid& g = plan.grid;
  account.cells =
      fmt::format("{} x {} x {} cells of side {:g}{}", g.cell_count[0], g.cell_count[1],
                  g.cell_count[2], g.cell_side, g.wraps() ? ", far ones share ids" : "");
  const Place a = list(account.i, plan);
  const Place b = list(account.j, plan);
  const CellRange shared = common(a.met, b.met);
  if (is_empty(shared)) return;
  account.meeting_count = phantoms_in(shared) + 1;
  for_each_cell(shared, [&](Cell cell) {
    Meeting m = {.cell = cell,
                 .id = cell_id(g, cell),
                 .home_of_i = is_same(cell, a.home),
                 .home_of_j = is_same(cell, b.home),
                 .tested = false,
                 .reason = {}};
    if (plan.rule == Rule::chapter32) {
      judge_chapter32(m, a, b);
    } else {
      judge_lowest(m, shared);
    }
    account.test_count += m.tested ? 1 : 0;
    account.meetings.push_back(m);
    return account.meetings.size() < kMostShown;  // the lowest cell comes first
  });
}

}  // namespace octocell::trace
