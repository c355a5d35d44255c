// SPDX-License-Identifier: MIT
// C. The range of float32: far offsets, the largest and the smallest numbers, and invalid ones.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/verify/stress/make.hpp"

namespace octocell::stress {
namespace {

std::vector<Case> offsets(std::size_t n) {
  std::vector<Case> cases;
  for (const double offset : {1e4, 1e6, 1e8, 0x1p24 - 1, 0x1p24, 0x1p24 + 1, 1e12, 1e20, -3e5}) {
    cases.push_back({.name = std::to_string(offset),
                     .spheres = moved(scene("dense", n), offset, offset, -offset)});
  }
  return cases;
}

std::vector<Case> one_at_the_end(std::size_t n) {
  std::vector<Case> cases;
  for (const float end : {kFloatMax, -kFloatMax}) {
    for (const float r : {0.5F, kFloatMax}) {
      cases.push_back({.name = r < 1.0F ? "small" : "huge",
                       .spheres = joined(scene("dense", n), {{end, end, end, r}})});
    }
  }
  return cases;
}

/// Radius sums and distances overflow, but that must not make everything overlap.
std::vector<Case> all_at_the_end(std::size_t n) {
  Random random(16);
  const auto coordinate = [&] { return in(random, kFloatMax / 2.0, kFloatMax); };
  Spheres large = repeated(n, [&](std::size_t) {
    const float x = coordinate();
    const float y = coordinate();
    return Sphere{x, y, coordinate(), in(random, 1e36, 1e38)};
  });
  Spheres both_ends = large;
  for (std::size_t k = 0; k < both_ends.size(); k += 2) both_ends[k].x = -both_ends[k].x;
  return {{.name = "one end", .spheres = std::move(large)},
          {.name = "both ends", .spheres = std::move(both_ends)}};
}

std::vector<Case> subnormal(std::size_t n) {
  Random random(17);
  Spheres tiny = repeated(n, [&](std::size_t) {
    const auto coordinate = [&] { return static_cast<float>(step(random, 400)) * 0x1p-149F; };
    const float x = coordinate();
    const float y = coordinate();
    return Sphere{x, y, coordinate(), static_cast<float>(random.below(64)) * 0x1p-149F};
  });
  return {{.name = "steps of 2^-149", .spheres = std::move(tiny)},
          {.name = "a gas of 2^-145", .spheres = scaled(scene("dense", n), 0x1p-145F)},
          {.name = "a lattice of 2^-126", .spheres = scaled(scene("lattice", n), 0x1p-126F)}};
}

/// Makes scenes of forty spheres: in larger ones everything overlaps something.
std::vector<Case> random_bits(std::size_t n) {
  Random random(18);
  std::vector<Case> cases;
  for (std::size_t round = 0; round < n / 40; ++round) {
    cases.push_back({.name = "scene " + std::to_string(round),
                     .spheres = repeated(40, [&](std::size_t) {
                       const float x = any_float(random);
                       const float y = any_float(random);
                       const float z = any_float(random);
                       return Sphere{x, y, z, std::fabs(any_float(random))};
                     })});
  }
  return cases;
}

std::vector<Case> landmarks(std::size_t n) {
  constexpr std::array kNumbers = {0.0F,
                                   -0.0F,
                                   0x1p-149F,
                                   -0x1p-149F,
                                   0x1p-126F,
                                   0x1.fffffcp-127F,
                                   0x1.000002p-126F,
                                   1.0F,
                                   -1.0F,
                                   0x1.000002p0F,
                                   0x1p24F,
                                   0x1p63F,
                                   -0x1p63F,
                                   0x1p127F,
                                   kFloatMax,
                                   -kFloatMax,
                                   0x1p-60F,
                                   0x1p62F,
                                   0x1p-62F,
                                   0x1p-75F};
  Random random(19);
  const auto number = [&] { return kNumbers[random.below(kNumbers.size())]; };
  std::vector<Case> cases;
  for (std::size_t round = 0; round < n / 40; ++round) {
    cases.push_back(
        {.name = "scene " + std::to_string(round), .spheres = repeated(40, [&](std::size_t) {
                                                     const float x = number();
                                                     const float y = number();
                                                     const float z = number();
                                                     return Sphere{x, y, z, std::fabs(number())};
                                                   })});
  }
  return cases;
}

/// One sphere of a gas is not valid: the last, the first, or one in between.
std::vector<Case> not_spheres(std::size_t n) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr std::array<Sphere, 9> kBad = {{{kNan, 0, 0, 1},
                                           {0, kInfinity, 0, 1},
                                           {0, 0, -kInfinity, 1},
                                           {0, 0, 0, kNan},
                                           {0, 0, 0, kInfinity},
                                           {0, 0, 0, -1},
                                           {0, 0, 0, -0x1p-149F},
                                           {0, 0, 0, -kInfinity},
                                           {kNan, kNan, kNan, kNan}}};
  std::vector<Case> cases;
  for (const Sphere& bad : kBad) {
    for (const std::size_t where : {std::size_t{0}, n / 2, n - 1}) {
      Case bad_case = {.name = "sphere " + std::to_string(where), .spheres = scene("gas", n)};
      bad_case.spheres[where] = bad;
      bad_case.bad_sphere = static_cast<std::uint32_t>(where);
      cases.push_back(std::move(bad_case));
    }
  }
  return cases;
}

constexpr Entry kRange[] = {
    {"C14", "far from the origin, to 1e20", {300, 3000, 100000}, offsets},
    {"C15", "one sphere at +-FLT_MAX", {300, 3000, 100000}, one_at_the_end},
    {"C16", "all centres beyond FLT_MAX / 2", {200, 2000, 20000}, all_at_the_end},
    {"C17", "subnormal numbers", {300, 2000, 50000}, subnormal},
    {"C18", "random bits", {2000, 20000, 1000000}, random_bits},
    {"C19", "zeros, least, greatest, and their neighbours", {1000, 10000, 200000}, landmarks},
    {"C20",
     "NaN, infinity, r < 0: refused with the index",
     {50, 1000, 100000},
     not_spheres,
     Ask::refusal},
};

}  // namespace

std::span<const Entry> range() { return kRange; }

}  // namespace octocell::stress
