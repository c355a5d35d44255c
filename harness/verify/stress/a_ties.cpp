// SPDX-License-Identifier: MIT
// A. Ties and rounding: spheres that touch exactly, or are an ulp away from touching.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/verify/stress/make.hpp"

namespace octocell::stress {
namespace {

std::vector<Case> tangent_lattice(std::size_t n) {
  const int side = side_of(n);
  const auto s = static_cast<std::uint64_t>(side);
  std::vector<Case> cases;
  for (const float spacing : {1.0F, 0x1p-30F, 0x1p40F}) {
    cases.push_back({.name = spacing == 1.0F  ? "1"
                             : spacing < 1.0F ? "2^-30"
                                              : "2^40",
                     .spheres = lattice_of(side,
                                           [spacing](int i, int j, int k) {
                                             return Sphere{spacing * static_cast<float>(i),
                                                           spacing * static_cast<float>(j),
                                                           spacing * static_cast<float>(k),
                                                           spacing / 2};
                                           }),
                     .pair_count = s == 0 ? 0 : 3 * s * s * (s - 1)});
  }
  return cases;
}

/// Returns half the sum over 0 < |v|^2 <= m of prod(side - |v_i|).
std::uint64_t lattice_pairs(int side, int m) {
  std::uint64_t twice = 0;
  const auto room = [side](int v) {
    return static_cast<std::uint64_t>(std::max(side - std::abs(v), 0));
  };
  for (int x = -m; x <= m; ++x) {
    for (int y = -m; y <= m; ++y) {
      for (int z = -m; z <= m; ++z) {
        const int square = x * x + y * y + z * z;
        if (square > 0 && square <= m) twice += room(x) * room(y) * room(z);
      }
    }
  }
  return twice / 2;
}

/// Returns the smallest float with (2r)^2 >= m; the square of a float is exact in float64.
float least_radius(int m) {
  const auto reaches = [m](float r) { return 4.0 * r * r >= m; };
  auto r = static_cast<float>(std::sqrt(m) / 2.0);
  while (reaches(nudged(r, -1))) r = nudged(r, -1);
  while (!reaches(r)) r = nudged(r, 1);
  return r;
}

Spheres integer_lattice_of(int side, float r) {
  return lattice_of(side, [r](int i, int j, int k) {
    return Sphere{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k), r};
  });
}

std::vector<Case> integer_lattice(std::size_t n) {
  const int side = side_of(n);
  std::vector<Case> cases;
  for (const int m : {1, 2, 3, 4, 5, 6, 8, 9, 12, 14, 16}) {
    const float r = least_radius(m);
    cases.push_back({.name = "s^2 = " + std::to_string(m),
                     .spheres = integer_lattice_of(side, r),
                     .pair_count = lattice_pairs(side, m)});
    cases.push_back({.name = "an ulp below s^2 = " + std::to_string(m),
                     .spheres = integer_lattice_of(side, nudged(r, -1)),
                     .pair_count = lattice_pairs(side, m - 1)});
  }
  return cases;
}

/// Uses k * 0.1 rounded twice, or once: other floats, other pairs.
std::vector<Case> decimal_lattice(std::size_t n) {
  const int side = side_of(n);
  const auto of = [side](auto coordinate) {
    return lattice_of(side, [&](int i, int j, int k) {
      return Sphere{coordinate(i), coordinate(j), coordinate(k), 0.05F};
    });
  };
  return {
      {.name = "float product", .spheres = of([](int k) { return static_cast<float>(k) * 0.1F; })},
      {.name = "double product", .spheres = of([](int k) { return static_cast<float>(k * 0.1); })}};
}

std::vector<Case> close_packings(std::size_t n) {
  const int side = side_of(n);
  constexpr double kEdge = 0.1;
  Spheres fcc = lattice_of(side, [](int i, int j, int k) {
    const double half = kEdge / 2;
    return Sphere{static_cast<float>((2 * i + (j + k) % 2) * half), static_cast<float>(j * half),
                  static_cast<float>(k * half), static_cast<float>(kEdge * std::sqrt(2.0) / 4)};
  });
  Spheres hcp = lattice_of(side, [](int i, int j, int k) {
    const double r = kEdge / 2;
    return Sphere{static_cast<float>((2 * i + (j + k) % 2) * r),
                  static_cast<float>(std::sqrt(3.0) * (j + (k % 2) / 3.0) * r),
                  static_cast<float>(2 * std::sqrt(6.0) / 3 * k * r), static_cast<float>(r)};
  });
  return {{.name = "fcc", .spheres = std::move(fcc)}, {.name = "hcp", .spheres = std::move(hcp)}};
}

/// Makes couples of spheres on integers whose squares add up; half of them have a number that is an
/// ulp off.
std::vector<Case> pythagorean(std::size_t n) {
  constexpr std::array<std::array<int, 4>, 7> kQuadruples = {{{1, 2, 2, 3},
                                                              {2, 3, 6, 7},
                                                              {1, 4, 8, 9},
                                                              {2, 6, 9, 11},
                                                              {3, 4, 12, 13},
                                                              {2, 5, 14, 15},
                                                              {0, 3, 4, 5}}};
  std::vector<Case> cases;
  for (const int exponent : {0, -20, 30, -120, 100}) {
    Random random(5);
    const auto scale = static_cast<float>(std::ldexp(1.0, exponent));
    Spheres spheres;
    for (std::size_t couple = 0; couple < n / 2; ++couple) {
      const auto& [x, y, z, radius_sum] = kQuadruples[random.below(kQuadruples.size())];
      const int part = static_cast<int>(random.below(static_cast<std::size_t>(radius_sum) + 1));
      const auto at = static_cast<float>(64 * (couple % 4096));
      const auto row = static_cast<float>(64 * (couple / 4096));
      const auto scaled_by = [scale](float v) { return v * scale; };
      spheres.push_back({scaled_by(at), scaled_by(row), 0, scaled_by(static_cast<float>(part))});
      Sphere other = {scaled_by(at + static_cast<float>(x)), scaled_by(row + static_cast<float>(y)),
                      scaled_by(static_cast<float>(z)),
                      scaled_by(static_cast<float>(radius_sum - part))};
      float* const numbers[] = {&other.x, &other.y, &other.z, &other.r};
      float& number = *numbers[random.below(4)];
      number = std::max(nudged(number, step(random, 1)), 0.0F);
      spheres.push_back(other);
    }
    cases.push_back({.name = "times 2^" + std::to_string(exponent), .spheres = std::move(spheres)});
  }
  return cases;
}

std::vector<Case> closed_balls(std::size_t n) {
  const int side = side_of(n);
  const auto s = static_cast<std::uint64_t>(side);
  return {{.name = "they touch",
           .spheres = integer_lattice_of(side, 0.5F),
           .pair_count = s == 0 ? 0 : 3 * s * s * (s - 1)},
          {.name = "an ulp less",
           .spheres = integer_lattice_of(side, nudged(0.5F, -1)),
           .pair_count = 0}};
}

/// Makes couples far from each other; the two spheres of each touch, up to rounding.
std::vector<Case> near_tangent(std::size_t n) {
  Random random(7);
  Spheres spheres;
  while (spheres.size() + 1 < n) {
    const double r = 0.05 + 0.45 * random.uniform();
    const double other = 0.05 + 0.45 * random.uniform();
    const double away[3] = {random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
    const double length = std::sqrt(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]);
    const auto row = static_cast<double>(4 * (spheres.size() / 2));
    const Sphere a = {static_cast<float>(row), in(random, -9, 9), in(random, -9, 9),
                      static_cast<float>(r)};
    const auto b_r = static_cast<float>(other);
    const double radius_sum = static_cast<double>(a.r) + b_r;
    const auto along = [&](float from, int axis) {
      return static_cast<float>(from + radius_sum * away[axis] / length);
    };
    spheres.push_back(a);
    spheres.push_back({along(a.x, 0), along(a.y, 1), along(a.z, 2), b_r});
  }
  Spheres exchanged = spheres;
  for (std::size_t k = 0; k + 1 < exchanged.size(); k += 2)
    std::swap(exchanged[k], exchanged[k + 1]);
  return {{.name = "(p, q)", .spheres = spheres}, {.name = "(q, p)", .spheres = exchanged}};
}

std::vector<Case> points(std::size_t n) {
  Random random(8);
  const std::size_t half = n / 2;
  Spheres distinct = repeated(half, [&](std::size_t k) {
    return Sphere{static_cast<float>(k), in(random, 0, 1), in(random, 0, 1), 0.0F};
  });
  Spheres twice = joined(distinct, distinct);
  Spheres zeros = {{0.0F, -0.0F, 0.0F, 0.0F}, {-0.0F, 0.0F, -0.0F, -0.0F}, {0x1p-149F, 0, 0, 0}};
  return {{.name = "all distinct", .spheres = std::move(distinct), .pair_count = 0},
          {.name = "each twice", .spheres = std::move(twice), .pair_count = half},
          {.name = "zeros of both signs", .spheres = std::move(zeros), .pair_count = 1}};
}

constexpr Entry kTies[] = {
    {"A1", "cubic lattice whose neighbours touch", {500, 8000, 1000000}, tangent_lattice},
    {"A2", "integer lattice, every (2r)^2 up to 16", {125, 1000, 27000}, integer_lattice},
    {"A3", "lattice of 0.1 steps, by float and by double", {500, 8000, 300000}, decimal_lattice},
    {"A4", "close packings, fcc and hcp", {500, 8000, 300000}, close_packings},
    {"A5", "Pythagorean quadruples, an ulp off or not", {400, 4000, 200000}, pythagorean},
    {"A6", "all spheres touch: <= and not <", {500, 8000, 300000}, closed_balls},
    {"A7", "near-tangent couples, either way round", {400, 4000, 200000}, near_tangent},
    {"A8", "points, once and twice, and zeros", {400, 4000, 200000}, points},
};

}  // namespace

std::span<const Entry> ties() { return kTies; }

}  // namespace octocell::stress
