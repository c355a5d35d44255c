// SPDX-License-Identifier: MIT
// Method half_shell: one cell a sphere; adjacent rows are compared as far as columns reach.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "harness/trace/why_rules.hpp"

namespace octocell::trace {
namespace {

struct Place {
  int level;
  Cell cell;
};

Place list(ListedSphere& s, const Levels& levels) {
  const int k = level_of(levels, s.sphere.r);
  const Level& level = levels.level[k];
  const Cell cell = cell_of(level.grid, s.sphere.x, s.sphere.y, s.sphere.z);
  s.cells.push_back({cell, level.first_id + cell_id(level.grid, cell), true});
  s.cell_count = 1;
  return {k, cell};
}

/// How many cells apart on an axis, the short way round where the axis wraps.
std::uint32_t steps_apart(const Grid& g, int axis, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t straight = a > b ? a - b : b - a;
  if (!g.wraps(axis)) return straight;
  const std::uint32_t period = g.period(axis);
  const std::uint32_t inside = straight % period;
  return std::min(inside, period - inside);
}

/// Spheres of one level: the one in the other's half shell is found from the other.
Meeting meet_in_level(const Level& level, Cell a, Cell b) {
  const Grid& g = level.grid;
  const std::uint32_t columns = steps_apart(g, 0, a.x, b.x);
  const std::uint32_t rows = std::max(steps_apart(g, 1, a.y, b.y), steps_apart(g, 2, a.z, b.z));
  Meeting m = {.cell = a,
               .id = level.first_id + cell_id(g, a),
               .home_of_i = true,
               .home_of_j = columns == 0 && rows == 0,
               .tested = rows <= 1 && columns <= level.column_reach,
               .reason = {}};
  const std::string where = rows == 0   ? "one row"
                            : rows == 1 ? "adjacent rows"
                                        : fmt::format("rows {} apart", rows);
  m.reason = fmt::format(
      "{}, {} column{} apart; a row is compared with itself and its neighbours, "
      "as far as {} column{}",
      where, columns, columns == 1 ? "" : "s", level.column_reach,
      level.column_reach == 1 ? "" : "s");
  return m;
}

bool is_between(std::uint32_t low, std::uint32_t at, std::uint32_t high) {
  return low <= at && at <= high;
}

/// Spheres of two levels: the larger looks at the cells of the finer level that its box meets, made
/// wider by that level's largest radius.
Meeting meet_across_levels(const Levels& levels, const ListedSphere& larger, const Place& finer,
                           bool larger_is_i) {
  const Level& level = levels.level[finer.level];
  const float reach =
      std::nextafter(larger.sphere.r + level.r_max, std::numeric_limits<float>::infinity());
  const CellRange met = cells_met(level.grid, larger.sphere, reach);
  const Cell c = finer.cell;
  Meeting m = {.cell = c,
               .id = level.first_id + cell_id(level.grid, c),
               .home_of_i = !larger_is_i,
               .home_of_j = larger_is_i,
               .tested = is_between(met.lowest.x, c.x, met.highest.x) &&
                         is_between(met.lowest.y, c.y, met.highest.y) &&
                         is_between(met.lowest.z, c.z, met.highest.z),
               .reason = {}};
  m.reason = m.tested ? "the larger sphere's box, wider by the finer level's largest radius, meets "
                        "this cell"
                      : "the larger sphere's box, wider by the finer level's largest radius, does "
                        "not meet this cell";
  return m;
}

std::string cells_of(const Levels& levels) {
  std::string text = "one cell a sphere";
  for (int k = 0; k < levels.count; ++k) {
    const Grid& g = levels.level[k].grid;
    text += fmt::format("; level {}: r <= {:g}, {} x {} rows of side {:g}, {} columns", k,
                        levels.level[k].r_max, g.cell_count[1], g.cell_count[2], g.cell_side,
                        g.cell_count[0]);
  }
  return text;
}

}  // namespace

void meet_in_rows(Account& account, const Plan& plan) {
  const Levels& levels = plan.levels;
  account.cells = cells_of(levels);
  const Place a = list(account.i, levels);
  const Place b = list(account.j, levels);
  Meeting m = a.level == b.level  ? meet_in_level(levels.level[a.level], a.cell, b.cell)
              : a.level > b.level ? meet_across_levels(levels, account.i, b, true)
                                  : meet_across_levels(levels, account.j, a, false);
  account.meeting_count = account.test_count = m.tested ? 1 : 0;
  account.meetings.push_back(std::move(m));
}

}  // namespace octocell::trace
