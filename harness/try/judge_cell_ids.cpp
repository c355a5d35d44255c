// SPDX-License-Identifier: MIT
// The mistakes that are tried are a table: each is stage 2 with one thing done otherwise.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "harness/try/judge_stage.hpp"

namespace octocell::hand_in {
namespace {

/// How stage 2 is done. The defaults are right.
struct Way {
  const char* name = "";
  const char* text = "";
  bool subtracts_corner = true;
  bool clamps = true;
  bool rounds = false;            // to the nearest whole number
  bool negative_is_last = false;  // a negative coordinate becomes a large unsigned one
  bool z_first = false;           // the id counts z fastest
  double side_factor = 1.0;
  double extent_factor = 1.0;
  bool lists_phantoms = true;
  bool lists_home_again = false;
  bool corners_only = false;  // of the box
  bool ball_only = false;     // cells that the box meets and the ball does not are left out
  bool highest_bits = false;
  std::uint32_t cleared_bits = 0;
  std::size_t most_phantoms = std::numeric_limits<std::size_t>::max();
};

constexpr std::uint32_t kLowestBits = OCTOCELL_LOWEST_X | OCTOCELL_LOWEST_Y | OCTOCELL_LOWEST_Z;
const Way kMistakes[] = {
    {.name = "corner ignored",
     .text = "the grid's corner is not subtracted",
     .subtracts_corner = false},
    {.name = "not clamped",
     .text = "cells outside of the grid are not clamped to its border",
     .clamps = false},
    {.name = "rounded",
     .text = "a coordinate is rounded to the nearest cell, not down",
     .rounds = true},
    {.name = "unsigned cells",
     .text = "a negative cell becomes the last one: a cast to an unsigned number",
     .negative_is_last = true},
    {.name = "axes exchanged", .text = "the ids count z fastest, not x", .z_first = true},
    {.name = "half the side", .text = "cells are half as wide as the grid's", .side_factor = 0.5},
    {.name = "twice the extent", .text = "boxes reach 2 r from the centre", .extent_factor = 2.0},
    {.name = "half the extent", .text = "boxes reach r / 2 from the centre", .extent_factor = 0.5},
    {.name = "no phantoms", .text = "only homes are listed", .lists_phantoms = false},
    {.name = "home listed again",
     .text = "the home is listed among the phantoms, too",
     .lists_home_again = true},
    {.name = "corners only",
     .text = "only the cells of the box's corners are listed, not those between them",
     .corners_only = true},
    {.name = "ball instead of box",
     .text = "cells that the box meets and the ball does not are left out",
     .ball_only = true},
    {.name = "highest for lowest",
     .text = "bits 28 to 30 mark the highest cell that a sphere meets",
     .highest_bits = true},
    {.name = "control bits lost",
     .text = "bits 28 to 31 of all objects are 0",
     .cleared_bits = ~OCTOCELL_SPHERE},
    {.name = "phantom bit lost",
     .text = "bit 31 of phantoms is 0",
     .cleared_bits = OCTOCELL_PHANTOM},
    {.name = "lowest bits lost",
     .text = "bits 28 to 30 of all objects are 0",
     .cleared_bits = kLowestBits},
    {.name = "seven phantoms",
     .text = "of each sphere at most seven phantoms are listed",
     .most_phantoms = 7},
};

using Cell = std::array<std::int64_t, 3>;

/// An entry that can be compared, whatever its place.
struct Entry {
  std::uint32_t sphere;
  std::uint32_t id;
  std::uint32_t object;
  friend auto operator<=>(const Entry&, const Entry&) = default;
};

/// Homes in the order of spheres; phantoms sorted.
struct Listed {
  std::vector<Entry> homes;
  std::vector<Entry> phantoms;
  friend bool operator==(const Listed&, const Listed&) = default;
};

class Lister {
 public:
  Lister(const octocell_grid& grid, const Way& way) : grid_(grid), way_(way) {}

  void list(const Sphere& s, std::uint32_t sphere, Listed& to) const {
    const std::array<float, 3> p = {s.x, s.y, s.z};
    const auto extent = static_cast<float>(way_.extent_factor * static_cast<double>(s.r));
    Cell home;
    Cell low;
    Cell high;
    for (std::size_t a = 0; a < 3; ++a) {
      home[a] = coordinate(a, p[a]);
      low[a] = coordinate(a, p[a] - extent);
      high[a] = coordinate(a, p[a] + extent);
    }
    to.homes.push_back(entry(sphere, home, low, high, 0));
    if (!way_.lists_phantoms || is_too_much(low, high)) return;
    const std::size_t before = to.phantoms.size();
    Cell c;
    for (c[2] = low[2]; c[2] <= high[2]; ++c[2])
      for (c[1] = low[1]; c[1] <= high[1]; ++c[1])
        for (c[0] = low[0]; c[0] <= high[0]; ++c[0]) {
          if (c == home && !way_.lists_home_again) continue;
          if (way_.corners_only && !is_corner(c, low, high)) continue;
          if (way_.ball_only && !ball_meets(p, extent, c)) continue;
          if (to.phantoms.size() - before == way_.most_phantoms) continue;
          to.phantoms.push_back(entry(sphere, c, low, high, OCTOCELL_PHANTOM));
        }
  }

 private:
  [[nodiscard]] std::int64_t coordinate(std::size_t axis, float value) const {
    const double from = way_.subtracts_corner ? grid_.corner[axis] : 0.0;
    const double cell = (static_cast<double>(value) - from) / (way_.side_factor * grid_.side);
    const double whole = way_.rounds ? std::round(cell) : std::floor(cell);
    const double last = static_cast<double>(grid_.cells[axis]) - 1.0;
    if (whole < 0.0 && way_.negative_is_last) return static_cast<std::int64_t>(last);
    return static_cast<std::int64_t>(way_.clamps ? std::clamp(whole, 0.0, last)
                                                 : std::clamp(whole, -1e6, 1e6));
  }

  [[nodiscard]] Entry entry(std::uint32_t sphere, const Cell& c, const Cell& low, const Cell& high,
                            std::uint32_t kind) const {
    const std::size_t fast = way_.z_first ? 2 : 0;
    const std::int64_t id = c[fast] + std::int64_t{grid_.cells[fast]} *
                                          (c[1] + std::int64_t{grid_.cells[1]} * c[2 - fast]);
    std::uint32_t object = sphere | kind;
    const Cell& marked = way_.highest_bits ? high : low;
    for (std::size_t a = 0; a < 3; ++a) object |= c[a] == marked[a] ? OCTOCELL_LOWEST_X << a : 0U;
    return {sphere, static_cast<std::uint32_t>(id), object & ~way_.cleared_bits};
  }

  static bool is_too_much(const Cell& low, const Cell& high) {
    std::int64_t cells = 1;
    for (std::size_t a = 0; a < 3; ++a)
      cells *= std::clamp<std::int64_t>(high[a] - low[a] + 1, 0, 100);
    return cells > 100'000;
  }
  static bool is_corner(const Cell& c, const Cell& low, const Cell& high) {
    for (std::size_t a = 0; a < 3; ++a)
      if (c[a] != low[a] && c[a] != high[a]) return false;
    return true;
  }
  [[nodiscard]] bool ball_meets(const std::array<float, 3>& p, float r, const Cell& c) const {
    double square = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double begin = grid_.corner[a] + static_cast<double>(c[a]) * grid_.side;
      const double gap = std::max({0.0, begin - p[a], p[a] - (begin + grid_.side)});
      square += gap * gap;
    }
    return square <= static_cast<double>(r) * r;
  }

  const octocell_grid& grid_;
  const Way& way_;
};

Listed listed_by(const Way& way, const Scene& scene, const octocell_grid& grid) {
  const Lister lister(grid, way);
  Listed listed;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i)
    lister.list(scene.spheres[i], static_cast<std::uint32_t>(i), listed);
  std::ranges::sort(listed.phantoms);
  return listed;
}

Listed listed_of(const Entries& entries, std::size_t homes) {
  Listed listed;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const std::uint32_t object = entries.objects[k];
    (k < homes ? listed.homes : listed.phantoms)
        .push_back({object & OCTOCELL_SPHERE, entries.ids[k], object});
  }
  std::ranges::sort(listed.phantoms);
  return listed;
}

std::string text_of(const Entry& entry) {
  return fmt::format("{} in cell {}", object_text(entry.object), entry.id);
}

WrongEntry first_difference(const Listed& got, const Listed& right) {
  for (std::size_t i = 0; i < right.homes.size(); ++i) {
    if (i == got.homes.size()) return {"homes", i, text_of(right.homes[i]), "nothing"};
    if (got.homes[i] != right.homes[i])
      return {"homes", i, text_of(right.homes[i]), text_of(got.homes[i])};
  }
  const auto [has, should] = std::ranges::mismatch(got.phantoms, right.phantoms);
  const auto place = static_cast<std::uint64_t>(should - right.phantoms.begin());
  const bool is_missing =
      should != right.phantoms.end() && (has == got.phantoms.end() || *should < *has);
  if (is_missing) return {"phantoms", place, text_of(*should), "not listed"};
  return {"phantoms", place, "not listed", text_of(*has)};
}

}  // namespace

StageJudgement judge_cell_ids(const Entries& got, const Scene& scene, const StageArrays& expected) {
  const std::size_t n = scene.spheres.size();
  const Listed has = listed_of(got, n);
  const Listed right = listed_of(expected.unsorted, n);
  if (has == right) return {};
  StageJudgement judgement = {.first = first_difference(has, right)};
  for (const Way& mistake : kMistakes) {
    if (has != listed_by(mistake, scene, expected.grid)) continue;
    judgement.cause = list_cause(mistake.name, mistake.text);
    break;
  }
  return judgement;
}

}  // namespace octocell::hand_in
