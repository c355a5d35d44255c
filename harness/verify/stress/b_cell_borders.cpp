// SPDX-License-Identifier: MIT
// B. Borders of cells: coordinates on them, boxes that end on them, numbers of cells at a limit.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/verify/stress/make.hpp"

namespace octocell::stress {
namespace {

Spheres at_borders(std::size_t n, float side, int ulps, std::uint64_t seed) {
  Random random(seed);
  const auto coordinate = [&] {
    return nudged(static_cast<float>(step(random, 8)) * side, step(random, ulps));
  };
  return repeated(n, [&](std::size_t) {
    const float x = coordinate();
    const float y = coordinate();
    return Sphere{x, y, coordinate(), side / 2};
  });
}

std::vector<Case> ulps_off_borders(std::size_t n) {
  std::vector<Case> cases;
  for (const float side : {1.0F, 0.7F, 0.1F, 3.0F}) {
    cases.push_back({.name = "side " + std::to_string(side),
                     .spheres = at_borders(n, side, 4, 9),
                     .cell_sides = {side}});
  }
  return cases;
}

std::vector<Case> around_zero(std::size_t n) {
  Random random(10);
  const auto coordinate = [&] { return static_cast<float>(step(random, 12)) * 0.3F; };
  Spheres spheres = repeated(n, [&](std::size_t) {
    const float x = coordinate();
    const float y = coordinate();
    return Sphere{x, y, coordinate(), 0.5F};
  });
  return {{.name = "steps of 0.3", .spheres = std::move(spheres), .cell_sides = {1.0, 0.3}}};
}

/// Uses one to four cells on an axis; and ids that wrap, because two clouds are far apart.
std::vector<Case> few_cells(std::size_t n) {
  Spheres cloud = scene("gas", n, "phi=0.3");
  float widest = 0.0F;
  for (const Sphere& s : cloud) widest = std::max(widest, 2 * std::fabs(s.x));
  std::vector<double> sides;
  for (const int cells : {1, 2, 3, 4}) sides.push_back(double{widest} / cells);
  std::vector<Case> cases = {{.name = "1 to 4 cells", .spheres = cloud, .cell_sides = sides}};
  for (const double offset : {1e5, 1e7, 1e10}) {
    Spheres half = cloud;
    half.resize(n / 2);
    cases.push_back({.name = "wrapped",
                     .spheres = joined(cloud, moved(half, offset, -offset, offset)),
                     .cell_sides = {1.0, 3.0}});
  }
  return cases;
}

/// The box ends on a border of cells, or an ulp before or after it.
std::vector<Case> powers_of_two_of_cells(std::size_t n) {
  std::vector<Case> cases;
  for (const float side : {1.0F, 0.1F}) {
    for (const int cells : {4, 16, 64}) {
      for (const int ulps : {-1, 0, 1}) {
        Random random(12);
        const float end = nudged(side * static_cast<float>(cells), ulps);
        Spheres spheres = repeated(n, [&](std::size_t) {
          const auto coordinate = [&] {
            return std::min(
                static_cast<float>(random.below(static_cast<std::size_t>(cells) + 1)) * side, end);
          };
          const float x = coordinate();
          const float y = coordinate();
          return Sphere{x, y, coordinate(), side / 2};
        });
        spheres.push_back({0, 0, 0, side / 2});
        spheres.push_back({end, end, end, side / 2});
        cases.push_back({.name = std::to_string(cells) + " cells",
                         .spheres = std::move(spheres),
                         .cell_sides = {side}});
      }
    }
  }
  return cases;
}

/// 2r is the side of a cell. Far from the origin, p - r and p + r are rounded apart, so a sphere
/// meets a third cell.
std::vector<Case> a_third_cell(std::size_t n) {
  std::vector<Case> cases;
  for (const float offset : {3e6F, 1.6e7F, -1e7F}) {
    Random random(13);
    Spheres spheres = repeated(n, [&](std::size_t) {
      const auto coordinate = [&] { return nudged(offset, step(random, 60)); };
      const float x = coordinate();
      const float y = coordinate();
      return Sphere{x, y, coordinate(), 0.7F};
    });
    cases.push_back({.name = "offset " + std::to_string(offset),
                     .spheres = std::move(spheres),
                     .cell_sides = {1.4, 2.0}});
  }
  return cases;
}

constexpr Entry kCellBorders[] = {
    {"B9", "0 to 4 ulps off borders of cells", {400, 3000, 50000}, ulps_off_borders},
    {"B10", "both sides of zero", {400, 3000, 50000}, around_zero},
    {"B11", "1 to 4 cells on an axis, and wrapped ids", {400, 3000, 50000}, few_cells},
    {"B12", "a box that ends on a border of cells", {200, 2000, 50000}, powers_of_two_of_cells},
    {"B13", "spheres as wide as a cell, rounded into a third", {400, 3000, 50000}, a_third_cell},
};

}  // namespace

std::span<const Entry> cell_borders() { return kCellBorders; }

}  // namespace octocell::stress
