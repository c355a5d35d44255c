// SPDX-License-Identifier: MIT
// E. Concentration: many spheres in one place, in a row, on a surface, in a small part of the box.
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

std::uint64_t all_pairs(std::size_t n) { return std::uint64_t{n} * (n - (n > 0 ? 1 : 0)) / 2; }

std::vector<Case> identical(std::size_t n) {
  std::vector<Case> cases;
  for (const Sphere& one :
       {Sphere{1, 2, 3, 0.5F}, Sphere{1, 2, 3, 0}, Sphere{1e30F, 0, 0, 1e-30F}}) {
    cases.push_back({.name = "r = " + std::to_string(one.r),
                     .spheres = Spheres(n, one),
                     .pair_count = all_pairs(n)});
  }
  return cases;
}

std::vector<Case> far_clusters(std::size_t n) {
  const Spheres cloud = scene("dense", n / 2);
  return {{.name = "1e10 apart", .spheres = joined(cloud, moved(cloud, 1e10, 1e10, -1e10))},
          {.name = "1e10 apart on one axis", .spheres = joined(cloud, moved(cloud, 1e10, 0, 0))}};
}

Spheres line(std::size_t n, float x, float y, float z) {
  return repeated(n, [&](std::size_t k) {
    const auto t = static_cast<float>(k);
    return Sphere{x * t, y * t, z * t, 0.75F};
  });
}

Spheres plane(std::size_t n) {
  Random random(27);
  const double side = std::sqrt(static_cast<double>(n)) * 0.8;
  return repeated(n, [&](std::size_t) {
    const float x = in(random, 0, side);
    return Sphere{x, 2.5F, in(random, 0, side), 0.5F};
  });
}

/// Makes points on the surface of a ball.
Spheres shell(std::size_t n) {
  Random random(28);
  const double radius = std::sqrt(static_cast<double>(n)) * 0.3;
  return repeated(n, [&](std::size_t) {
    for (;;) {
      const double x = 2 * random.uniform() - 1;
      const double y = 2 * random.uniform() - 1;
      const double z = 2 * random.uniform() - 1;
      const double length = std::sqrt(x * x + y * y + z * z);
      if (length < 0.1 || length > 1.0) continue;
      const auto out = [&](double v) { return static_cast<float>(v / length * radius); };
      return Sphere{out(x), out(y), out(z), 0.5F};
    }
  });
}

/// Makes a circle by rational functions that widens and rises.
Spheres spiral(std::size_t n) {
  return repeated(n, [n](std::size_t k) {
    const double turn = static_cast<double>(k % 64) / 32.0 - 1.0;
    const double wide = 1.0 + static_cast<double>(k) / static_cast<double>(n) * 20.0;
    const double over = 1.0 + turn * turn;
    return Sphere{static_cast<float>(wide * (1.0 - turn * turn) / over),
                  static_cast<float>(wide * 2.0 * turn / over),
                  static_cast<float>(static_cast<double>(k) * 0.01), 0.3F};
  });
}

std::vector<Case> thin_shapes(std::size_t n) {
  std::vector<Case> cases = {{.name = "line", .spheres = line(n, 1, 0, 0)},
                             {.name = "diagonal", .spheres = line(n, 1, 1, 1)},
                             {.name = "plane", .spheres = plane(n)},
                             {.name = "shell", .spheres = shell(n)},
                             {.name = "spiral", .spheres = spiral(n)}};
  Spheres slab = plane(n);
  Random random(29);
  for (Sphere& s : slab) s.y = in(random, -0.5, 0.5);
  cases.push_back({.name = "slab", .spheres = std::move(slab)});
  const std::size_t shapes = cases.size();
  for (std::size_t k = 0; k < shapes; ++k) {
    cases.push_back(
        {.name = cases[k].name + ", shuffled", .spheres = shuffled(cases[k].spheres, 27)});
  }
  return cases;
}

/// Makes dust close to a sphere that makes cells large; the dust is too small to overlap much.
std::vector<Case> one_cell(std::size_t n) {
  Random random(30);
  Spheres dust = repeated(n, [&](std::size_t) {
    const float x = in(random, 0, 1);
    const float y = in(random, 0, 1);
    return Sphere{x, y, in(random, 0, 1), 1e-4F};
  });
  Spheres with_giants = joined(dust, {{100, 0, 0, 50}, {-100, 0, 0, 50}});
  return {{.name = "dust", .spheres = std::move(dust), .cell_sides = {2.0}},
          {.name = "dust between giants", .spheres = std::move(with_giants)}};
}

std::vector<Case> teapot(std::size_t n) {
  const Spheres stadium = scaled(scene("gas", n / 10 + 1), 1000.0F);
  Spheres pot = scene("dense", n - n / 10 - 1);
  return {{.name = "90 % in a thousandth", .spheres = joined(stadium, moved(pot, 17, -29, 3))}};
}

std::vector<Case> rows(std::size_t n) {
  const std::uint64_t links = n > 0 ? n - 1 : 0;
  Spheres chain = repeated(n, [](std::size_t k) {
    return Sphere{static_cast<float>(k), 0, 0, 0.5F};
  });
  Spheres backwards(chain.rbegin(), chain.rend());
  return {{.name = "in order", .spheres = chain, .pair_count = links},
          {.name = "backwards", .spheres = std::move(backwards), .pair_count = links},
          {.name = "shuffled", .spheres = shuffled(chain, 30), .pair_count = links}};
}

constexpr Entry kConcentration[] = {
    {"E25", "identical spheres", {200, 1500, 10000}, identical},
    {"E26", "two clusters 1e10 apart", {600, 6000, 300000}, far_clusters},
    {"E27", "lines, planes, shells, spirals, slabs", {400, 4000, 300000}, thin_shapes},
    {"E28", "many in one cell, hardly one overlaps", {1000, 10000, 100000}, one_cell},
    {"E29", "a teapot in a stadium", {1000, 10000, 300000}, teapot},
    {"E30", "a row, in order, backwards, shuffled", {300, 5000, 300000}, rows},
};

}  // namespace

std::span<const Entry> concentration() { return kConcentration; }

}  // namespace octocell::stress
