// SPDX-License-Identifier: MIT
#include "course/page/trace.hpp"

#include <algorithm>
#include <cstddef>

#include "core/as_written.hpp"
#include "core/chapter32.hpp"
#include "core/digit_plan.hpp"
#include "core/overlap.hpp"
#include "core/planner/planner.hpp"

namespace course {
namespace {

namespace as_written = octocell::as_written;
namespace chapter32 = octocell::chapter32;
using octocell::CellRange;
using octocell::Grid;
using octocell::PlanFacts;

constexpr std::uint32_t kSlots = 8;  // a sphere, in the text
constexpr int kTextDigit = 8;        // bits of a digit, in the text
constexpr int kWidestDigit = 9;      // of impl_cpu's sort
constexpr int kMostLevelBits = 30;

bool is_same(Cell a, Cell b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

PlanFacts facts_of(std::span<const Sphere> spheres) {
  PlanFacts facts;
  facts.sphere_count = spheres.size();
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const float p[3] = {spheres[k].x, spheres[k].y, spheres[k].z};
    for (int axis = 0; axis < 3; ++axis) {
      facts.lowest[axis] = k == 0 ? p[axis] : std::min(facts.lowest[axis], p[axis]);
      facts.highest[axis] = k == 0 ? p[axis] : std::max(facts.highest[axis], p[axis]);
    }
    facts.r_max = std::max(facts.r_max, spheres[k].r);
  }
  return facts;
}

void describe(Trace& t, const Grid& grid) {
  t.side = grid.cell_side;
  t.key_bits = grid.key_bits;
  for (int axis = 0; axis < 3; ++axis) {
    t.corner[axis] = grid.first_unit[axis] / grid.units_per_length;
    t.counts[axis] = grid.cell_count[axis];
  }
  t.column = grid.width[0].units / static_cast<double>(grid.units_per_length);
}

// ---- Stage 2: which cells does each sphere lie in?

struct Text {
  std::span<const Sphere> spheres;
  float side;

  [[nodiscard]] std::uint32_t home_id(std::uint32_t sphere) const {
    return as_written::hash(as_written::home(spheres[sphere], side));
  }
};

/// Eight slots a sphere: the home cell, then up to seven phantoms in the text's order.
void list_as_written(Trace& t, const Text& text) {
  t.side = t.column = text.side;
  t.key_bits = as_written::kIdBits;
  t.entries.resize(kSlots * text.spheres.size());
  for (std::uint32_t i = 0; i < text.spheres.size(); ++i) {
    const Sphere& s = text.spheres[i];
    const as_written::Coordinates home = as_written::home(s, text.side);
    std::uint32_t slot = kSlots * i;
    t.entries[slot++] = {as_written::hash(home), i, false, {home.x, home.y, home.z}};
    for (int k = 0; k < 27 && slot < kSlots * (i + 1); ++k) {
      const int step[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
      const std::uint32_t from[3] = {home.x, home.y, home.z};
      std::uint32_t at[3];
      bool is_inside = k != 13;
      for (int axis = 0; axis < 3; ++axis) {
        is_inside &= step[axis] < 0 ? from[axis] > 0 : step[axis] == 0 || from[axis] < ~0U;
        at[axis] = from[axis] + static_cast<std::uint32_t>(step[axis]);
      }
      const as_written::Coordinates c = {at[0], at[1], at[2]};
      if (!is_inside || !as_written::ball_meets(s, c, text.side)) continue;
      t.entries[slot++] = {as_written::hash(c), i, true, {c.x, c.y, c.z}};
    }
  }
}

/// All homes, then all phantoms: a stable sort then leaves homes first in every cell.
void list_homes_first(Trace& t, const Grid& grid, std::span<const Sphere> spheres, Rule rule) {
  std::vector<Entry> phantoms;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const Sphere& s = spheres[i];
    const float extent = rule == Rule::chapter32 ? chapter32::extent(s.r) : s.r;
    const Cell home = octocell::cell_of(grid, s.x, s.y, s.z);
    const CellRange met = octocell::cells_met(grid, s, extent);
    t.entries.push_back({octocell::cell_id(grid, home), i, false, home});
    for (std::uint32_t z = met.lowest.z; z <= met.highest.z; ++z) {
      for (std::uint32_t y = met.lowest.y; y <= met.highest.y; ++y) {
        for (std::uint32_t x = met.lowest.x; x <= met.highest.x; ++x) {
          const Cell c = {x, y, z};
          if (!is_same(c, home)) phantoms.push_back({octocell::cell_id(grid, c), i, true, c});
        }
      }
    }
  }
  t.entries.insert(t.entries.end(), phantoms.begin(), phantoms.end());
}

// ---- Stage 3: a stable radix sort, lowest digit first.

Pass sort_by(const std::vector<Entry>& before, octocell::Digit digit) {
  const std::size_t digits = std::size_t{1} << digit.width;
  Pass pass = {digit.shift,
               digit.width,
               std::vector<std::uint32_t>(digits),
               std::vector<std::uint32_t>(digits),
               {},
               std::vector<Entry>(before.size())};
  const auto digit_of = [&](const Entry& e) { return e.cell_id >> digit.shift & (digits - 1); };
  for (const Entry& e : before) ++pass.counts[digit_of(e)];
  for (std::size_t d = 1; d < digits; ++d)
    pass.offsets[d] = pass.offsets[d - 1] + pass.counts[d - 1];
  std::vector<std::uint32_t> next = pass.offsets;
  for (const Entry& e : before) {
    pass.places.push_back(next[digit_of(e)]++);
    pass.entries[pass.places.back()] = e;
  }
  return pass;
}

void sort(Trace& t, int widest) {
  const octocell::DigitPlan plan = octocell::digit_plan(t.key_bits, widest);
  for (int k = 0; k < plan.passes; ++k) {
    const std::vector<Entry>& before = k == 0 ? t.entries : t.passes.back().entries;
    t.passes.push_back(sort_by(before, plan.digits[k]));
  }
}

const std::vector<Entry>& sorted(const Trace& t) {
  return t.passes.empty() ? t.entries : t.passes.back().entries;
}

// ---- Stage 4: where does each cell begin, how many homes and phantoms does it hold?

void index(Trace& t) {
  const std::vector<Entry>& entries = sorted(t);
  for (std::uint32_t k = 0; k < entries.size(); ++k) {
    const Entry& e = entries[k];
    if (e.cell_id == kEmpty) continue;
    if (t.cells.empty() || t.cells.back().cell_id != e.cell_id)
      t.cells.push_back({e.cell_id, k, 0, 0});
    ++(e.is_phantom ? t.cells.back().phantoms : t.cells.back().homes);
  }
}

// ---- Stages 5 and 6: what does the rule say of each two entries of a cell, and do they overlap?

struct Decision {
  bool is_tested;
  Reason reason;
};

Decision decide_as_written(const Text& text, const Entry& a, const Entry& b) {
  if (a.is_phantom && b.is_phantom) return {false, Reason::both_phantoms};
  if (!a.is_phantom && !b.is_phantom) return {true, Reason::home_with_home};
  const Entry& home = a.is_phantom ? b : a;
  const Entry& phantom = a.is_phantom ? a : b;
  if (text.home_id(phantom.sphere) > text.home_id(home.sphere))
    return {true, Reason::phantom_has_larger_home};
  return {false, Reason::phantom_has_smaller_home};
}

struct Chapter {
  std::vector<chapter32::ControlBits> bits;

  Chapter(const Grid& grid, std::span<const Sphere> spheres) {
    for (const Sphere& s : spheres) {
      const CellRange met = octocell::cells_met(grid, s, chapter32::extent(s.r));
      bits.push_back(chapter32::control_bits_of(met, octocell::cell_of(grid, s.x, s.y, s.z)));
    }
  }
  [[nodiscard]] Decision decide(const Entry& a, const Entry& b) const {
    if (a.is_phantom && b.is_phantom) return {false, Reason::both_phantoms};
    const std::uint32_t type = chapter32::cell_type(a.cell);
    if (!chapter32::tests_pair_here(type, bits[a.sphere], bits[b.sphere]))
      return {false, Reason::home_of_lower_type_holds_both};
    return {true, Reason::no_home_of_lower_type_holds_both};
  }
};

Decision decide_lowest(const Grid& grid, std::span<const Sphere> spheres, const Entry& a,
                       const Entry& b) {
  const Sphere& p = spheres[a.sphere];
  const Sphere& q = spheres[b.sphere];
  const Cell low_p = octocell::cells_met(grid, p, p.r).lowest;
  const Cell low_q = octocell::cells_met(grid, q, q.r).lowest;
  const Cell lowest = {std::max(low_p.x, low_q.x), std::max(low_p.y, low_q.y),
                       std::max(low_p.z, low_q.z)};
  if (is_same(a.cell, lowest)) return {true, Reason::lowest_common_cell};
  return {false, Reason::not_lowest_common_cell};
}

void consider(Trace& t, std::span<const Sphere> spheres, const Entry& a, const Entry& b,
              Decision decision) {
  const std::uint32_t i = std::min(a.sphere, b.sphere);
  const std::uint32_t j = std::max(a.sphere, b.sphere);
  Verdict verdict = Verdict::passed_over;
  if (decision.is_tested) {
    verdict = octocell::overlap_exact(spheres[i], spheres[j]) ? Verdict::overlap : Verdict::apart;
    if (verdict == Verdict::overlap) t.pairs.push_back({i, j});
  }
  t.considered.push_back({i, j, a.cell_id, verdict, decision.reason});
}

/// Each two entries of each cell, in their order.
template <typename Decide>
void test_cells(Trace& t, std::span<const Sphere> spheres, Decide decide) {
  const std::vector<Entry>& entries = sorted(t);
  for (const IndexCell& cell : t.cells) {
    const std::uint32_t end = cell.begin + cell.homes + cell.phantoms;
    for (std::uint32_t k = cell.begin; k < end; ++k) {
      for (std::uint32_t l = k + 1; l < end; ++l)
        consider(t, spheres, entries[k], entries[l], decide(entries[k], entries[l]));
    }
  }
}

/// half_shell: each sphere against those behind it in its own row and in neighbouring rows, as far
/// as columns reach.
void test_rows(Trace& t, std::span<const Sphere> spheres, std::uint32_t reach) {
  const std::vector<Entry>& entries = sorted(t);
  const auto apart = [](std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; };
  for (std::size_t k = 0; k < entries.size(); ++k) {
    for (std::size_t l = k + 1; l < entries.size(); ++l) {
      const Cell a = entries[k].cell;
      const Cell b = entries[l].cell;
      if (apart(a.x, b.x) > reach || apart(a.y, b.y) > 1 || apart(a.z, b.z) > 1) continue;
      const bool is_row = a.y == b.y && a.z == b.z;
      consider(t, spheres, entries[k], entries[l],
               {true, is_row ? Reason::same_row : Reason::neighbouring_row});
    }
  }
}

void trace_text(Trace& t, std::span<const Sphere> spheres, const PlanFacts& facts) {
  const Text text = {spheres, as_written::cell_side(facts.r_max)};
  list_as_written(t, text);
  sort(t, kTextDigit);
  index(t);
  test_cells(t, spheres,
             [&](const Entry& a, const Entry& b) { return decide_as_written(text, a, b); });
}

void trace_chapter(Trace& t, std::span<const Sphere> spheres, const PlanFacts& facts) {
  const Grid grid =
      octocell::make_grid(facts, chapter32::cell_side(facts.r_max),
                          octocell::widest_box(facts, chapter32::extent(facts.r_max)));
  describe(t, grid);
  list_homes_first(t, grid, spheres, Rule::chapter32);
  sort(t, kWidestDigit);
  index(t);
  const Chapter chapter(grid, spheres);
  test_cells(t, spheres, [&](const Entry& a, const Entry& b) { return chapter.decide(a, b); });
}

void trace_lowest(Trace& t, std::span<const Sphere> spheres, const PlanFacts& facts, double side) {
  const Grid grid = octocell::make_grid(facts, side > 0 ? side : 2.0 * facts.r_max,
                                        octocell::widest_box(facts, facts.r_max));
  describe(t, grid);
  list_homes_first(t, grid, spheres, Rule::lowest_cell);
  sort(t, kWidestDigit);
  index(t);
  test_cells(t, spheres,
             [&](const Entry& a, const Entry& b) { return decide_lowest(grid, spheres, a, b); });
}

void trace_half_shell(Trace& t, std::span<const Sphere> spheres, const PlanFacts& facts) {
  const octocell::Level level = octocell::make_level(facts, facts.r_max, 0.0, 2, kMostLevelBits);
  describe(t, level.grid);
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const Cell cell = octocell::cell_of(level.grid, spheres[i].x, spheres[i].y, spheres[i].z);
    t.entries.push_back({octocell::cell_id(level.grid, cell), i, false, cell});
  }
  sort(t, kWidestDigit);
  index(t);
  test_rows(t, spheres, level.column_reach);
}

bool comes_before(Pair a, Pair b) { return a.i != b.i ? a.i < b.i : a.j < b.j; }

}  // namespace

Trace trace_scene(std::span<const Sphere> spheres, Rule rule, double side) {
  Trace t;
  const PlanFacts facts = facts_of(spheres);
  switch (rule) {
    case Rule::as_written:
      trace_text(t, spheres, facts);
      break;
    case Rule::chapter32:
      trace_chapter(t, spheres, facts);
      break;
    case Rule::lowest_cell:
      trace_lowest(t, spheres, facts, side);
      break;
    case Rule::half_shell:
      trace_half_shell(t, spheres, facts);
      break;
  }
  std::sort(t.pairs.begin(), t.pairs.end(), comes_before);
  return t;
}

std::vector<Pair> exact_pairs(std::span<const Sphere> spheres) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    for (std::uint32_t j = i + 1; j < spheres.size(); ++j) {
      if (octocell::overlap_exact(spheres[i], spheres[j])) pairs.push_back({i, j});
    }
  }
  return pairs;
}

}  // namespace course
