// SPDX-License-Identifier: MIT
// What cells may have to do with the loss of a pair. Nobody tells the judge how a program cuts
// space, so it tries the sides and origins that are usual.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "harness/judge/hypotheses.hpp"

namespace octocell::judge {
namespace {

using Steps = std::array<long, 3>;  // or a cell

struct SideChoice {
  float factor;  // of the largest radius
  const char* text;
};
constexpr SideChoice kSides[] = {{2.0F, "2 r_max"},
                                 {1.5F, "1.5 r_max"},
                                 {3.0F, "3 r_max"},
                                 {1.0F, "r_max"},
                                 {4.0F, "4 r_max"},
                                 {2.5F, "2.5 r_max"},
                                 {4.24264069F, "3 sqrt 2 r_max"}};

/// Cubes of one side.
struct Cells {
  float side;
  std::array<float, 3> origin;
  std::string text;

  [[nodiscard]] Steps home(const Sphere& s) const {
    Steps cell = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float at = std::floor((centre_of(s)[axis] - origin[axis]) / side);
      cell[axis] = static_cast<long>(std::clamp(at, -4e9F, 4e9F));
    }
    return cell;
  }
  [[nodiscard]] bool meets(const Sphere& s, const Steps& cell) const {
    float distance2 = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float p = centre_of(s)[axis];
      const float low = origin[axis] + static_cast<float>(cell[axis]) * side;
      const float gap = p < low ? low - p : std::max(p - (low + side), 0.0F);
      distance2 += gap * gap;
    }
    return distance2 <= s.r * s.r;
  }
};

std::vector<Cells> usual_cells(const SceneFacts& facts) {
  std::vector<Cells> all;
  if (!(facts.r_max > 0.0F)) return all;
  for (const SideChoice& side : kSides) {
    const auto add = [&](std::array<float, 3> origin, const char* from) {
      all.push_back({side.factor * facts.r_max, origin,
                     fmt::format("cells of side {} from {}", side.text, from)});
    };
    add({0, 0, 0}, "the origin");
    add(facts.lowest, "the lowest centre");
    add(facts.box_lowest, "the lowest p - r");
  }
  return all;
}

/// Cells of a scene, numbered: x + nx (y + ny z), or with z as the fastest.
struct NumberedCells {
  Cells cells;
  const SceneFacts* facts;
  Steps first;
  Steps count;

  NumberedCells(Cells with, const SceneFacts& of)
      : cells(std::move(with)), facts(&of), first(home_of(of.lowest)), count(home_of(of.highest)) {
    for (std::size_t axis = 0; axis < 3; ++axis) count[axis] += 1 - first[axis];
  }
  [[nodiscard]] Steps home_of(std::array<float, 3> p) const {
    return cells.home({p[0], p[1], p[2], 0.0F});
  }
  [[nodiscard]] Steps home(std::uint32_t id) const { return cells.home(facts->spheres[id]); }
  [[nodiscard]] double number(std::uint32_t id, bool z_is_fastest) const {
    Steps at = home(id);
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] -= first[axis];
    const auto [fast, slow] = z_is_fastest ? std::pair(2, 0) : std::pair(0, 2);
    return static_cast<double>(at[fast]) +
           static_cast<double>(count[fast]) *
               (static_cast<double>(at[1]) +
                static_cast<double>(count[1]) * static_cast<double>(at[slow]));
  }
  /// Returns the steps from one home to the other; the first that is not zero is positive.
  [[nodiscard]] Steps steps(Pair pair) const {
    const Steps a = home(pair.i);
    const Steps b = home(pair.j);
    Steps d = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const auto nonzero = std::ranges::find_if(d, [](long step) { return step != 0; });
    if (nonzero != d.end() && *nonzero < 0) d = {-d[0], -d[1], -d[2]};
    return d;
  }
};

/// One choice of cells, to which hypotheses are added.
class OfCells {
 public:
  OfCells(Hypotheses& all, Cells cells, const SceneFacts& facts)
      : all_(all),
        facts_(facts),
        cells_(std::make_shared<const NumberedCells>(std::move(cells), facts)) {}

  void add_all(Pair example) {
    add_direction(example);
    add_steps();
    add_homes();
    add_numbers();
    if (facts_.spheres.size() <= kMostSorted) add_blocks();
  }

 private:
  static constexpr std::size_t kMostSorted = 200'000;

  void add(std::string name, const std::string& text, std::function<bool(Pair)> holds) {
    all_.push_back({.name = std::move(name),
                    .text = fmt::format("{} ({})", text, cells_->cells.text),
                    .holds = std::move(holds)});
  }

  void add_direction(Pair example) {
    const Steps d = cells_->steps(example);
    const bool is_neighbour = std::ranges::all_of(d, [](long step) { return std::abs(step) <= 1; });
    if (!is_neighbour || d == Steps{}) return;
    add("one direction",
        fmt::format("lie in two cells that are neighbours in direction ({}, {}, {})", d[0], d[1],
                    d[2]),
        [c = cells_, d](Pair pair) { return c->steps(pair) == d; });
  }

  void add_steps() {
    const auto differing = [](const Steps& d) {
      return std::ranges::count_if(d, [](long step) { return step != 0; });
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      add("one axis", fmt::format("lie in cells that differ along {}", "xyz"[axis]),
          [c = cells_, axis](Pair pair) { return c->steps(pair)[axis] != 0; });
    }
    add("corners", "lie in cells that touch at a corner only",
        [c = cells_, differing](Pair pair) { return differing(c->steps(pair)) == 3; });
    add("edges and corners", "lie in cells that touch at an edge or a corner only",
        [c = cells_, differing](Pair pair) { return differing(c->steps(pair)) >= 2; });
    add("other cells", "lie in two different cells",
        [c = cells_](Pair pair) { return c->steps(pair) != Steps{}; });
    add("far cells", "lie in cells that are not neighbours", [c = cells_](Pair pair) {
      const Steps d = c->steps(pair);
      return std::ranges::any_of(d, [](long step) { return std::abs(step) > 1; });
    });
  }

  void add_homes() {
    add("both phantoms", "meet only in cells that are home to neither", [c = cells_](Pair pair) {
      const Sphere& a = c->facts->spheres[pair.i];
      const Sphere& b = c->facts->spheres[pair.j];
      const Steps home_a = c->cells.home(a);
      const Steps home_b = c->cells.home(b);
      return home_a != home_b && !c->cells.meets(a, home_b) && !c->cells.meets(b, home_a);
    });
  }

  void add_numbers() {
    for (const int bits : {8, 10, 16}) {
      const double size = std::ldexp(1.0, bits);
      add(fmt::format("cell numbers of {} bits", bits),
          fmt::format("lie across cell {:.0f} of an axis or a multiple of it", size),
          [c = cells_, bits](Pair pair) {
            const Steps a = c->home(pair.i);
            const Steps b = c->home(pair.j);
            for (std::size_t axis = 0; axis < 3; ++axis)
              if (a[axis] >> bits != b[axis] >> bits) return true;
            return false;
          });
    }
    for (const bool z_is_fastest : {false, true}) {
      for (const int bits : {15, 16, 31, 32}) {
        add(fmt::format("cell ids of {} bits", bits),
            fmt::format("have a sphere in a cell whose number, {} the fastest, is 2^{} or more",
                        z_is_fastest ? "z" : "x", bits),
            [c = cells_, z_is_fastest, least = std::ldexp(1.0, bits)](Pair pair) {
              return c->number(pair.i, z_is_fastest) >= least ||
                     c->number(pair.j, z_is_fastest) >= least;
            });
      }
    }
  }

  /// Borders of blocks of spheres that are sorted by their cells.
  void add_blocks() {
    for (const bool z_is_fastest : {false, true}) {
      const auto places =
          std::make_shared<const std::vector<std::uint32_t>>(places_by_cell(z_is_fastest));
      for (const std::uint32_t block : {32U, 64U, 128U, 256U, 512U, 1024U}) {
        if (facts_.spheres.size() <= block) continue;
        add("block borders",
            fmt::format("lie across a border of {} entries, sorted by cell, {} the fastest", block,
                        z_is_fastest ? "z" : "x"),
            [places, block](Pair pair) {
              return (*places)[pair.i] / block != (*places)[pair.j] / block;
            });
      }
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> places_by_cell(bool z_is_fastest) const {
    const std::size_t n = facts_.spheres.size();
    std::vector<double> numbers(n);
    for (std::uint32_t id = 0; id < n; ++id) numbers[id] = cells_->number(id, z_is_fastest);
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t id) { return numbers[id]; });
    std::vector<std::uint32_t> places(n);
    for (std::uint32_t k = 0; k < n; ++k) places[order[k]] = k;
    return places;
  }

  Hypotheses& all_;
  const SceneFacts& facts_;
  std::shared_ptr<const NumberedCells> cells_;
};

}  // namespace

void add_cells(Hypotheses& all, const SceneFacts& facts, Pair example) {
  for (Cells& cells : usual_cells(facts)) OfCells(all, std::move(cells), facts).add_all(example);
}

void add_several_cells(Hypotheses& all, const SceneFacts& facts) {
  for (const Cells& cells : usual_cells(facts)) {
    all.push_back(
        {.name = "several cells",
         .text = fmt::format("have boxes that meet in more than one cell ({})", cells.text),
         .holds = [cells, &facts](Pair pair) {
           const auto corner = [&](std::uint32_t id, float sign) {
             const Sphere& s = facts.spheres[id];
             return cells.home({s.x + sign * s.r, s.y + sign * s.r, s.z + sign * s.r, 0});
           };
           long common = 1;
           for (std::size_t axis = 0; axis < 3; ++axis) {
             const long low = std::max(corner(pair.i, -1)[axis], corner(pair.j, -1)[axis]);
             const long high = std::min(corner(pair.i, 1)[axis], corner(pair.j, 1)[axis]);
             common *= std::max(high - low + 1, 0L);
           }
           return common > 1;
         }});
    all.push_back(
        {.name = "two homes",
         .text = fmt::format("lie in two different cells, and are met from each ({})", cells.text),
         .holds = [cells, &facts](Pair pair) {
           return cells.home(facts.spheres[pair.i]) != cells.home(facts.spheres[pair.j]);
         }});
  }
}

}  // namespace octocell::judge
