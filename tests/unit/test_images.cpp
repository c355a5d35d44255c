// SPDX-License-Identifier: MIT
// Boxes that repeat, and cutoffs: the pairs of images, against rational numbers and all shifts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "include/octocell/octocell.hpp"
#include "tests/support/image_pairs.hpp"
#include "tests/support/sanitized.hpp"

namespace octocell {
namespace {

using namespace image_tests;

TEST(Images, ASphereMeetsTheOtherSideOfTheBox) {
  const std::vector<Sphere> spheres = {{0.5F, 5, 5, 1}, {9, 5, 5, 1}, {5, 5, 5, 1}};
  // Sphere 0, moved by one box, is at 10.5: 1.5 from sphere 1.
  expect_found(spheres, {.box = cube(10)}, {{{0, 1}, {1, 0, 0}}});
  const Box flat = {.vector = {{10, 0, 0}, {0, 10, 0}, {0, 0, 10}},
                    .periodic = {false, true, true}};
  expect_found(spheres, {.box = flat}, {});
}

TEST(Images, ASphereMeetsItsOwnImages) {
  expect_found(std::vector<Sphere>{{3, 3, 3, 0.5F}}, {.box = cube(1)},
               {{{0, 0}, {0, 0, 1}}, {{0, 0}, {0, 1, 0}}, {{0, 0}, {1, 0, 0}}});
}

TEST(Images, ShiftsAreThoseOfAnotherFormula) {
  // Written without the box: sphere i stays, sphere j's image is at p_j - S H.
  Random random(1);
  const Box box = box_of(4, 1, 5, -1.5F, 2, 6);
  const std::vector<Sphere> spheres = in_box(random, 40, box, 0.2, 1);
  const Pairs pairs = find_pairs(spheres, {.box = box});
  ASSERT_GT(pairs.size(), 20U);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const Shift s = pairs.shifts()[k];
    const double x = spheres[j].x - (s.a * 4.0 + s.b * 1.0 - s.c * 1.5);
    const double y = spheres[j].y - (s.b * 5.0 + s.c * 2.0);
    const double z = spheres[j].z - s.c * 6.0;
    EXPECT_LE(std::hypot(spheres[i].x - x, spheres[i].y - y, spheres[i].z - z),
              (spheres[i].r + spheres[j].r) * (1 + 1e-9));
  }
}

struct BoxCase {
  const char* name;
  Box box;
  int most;  // shifts that must be tried
};
std::vector<BoxCase> boxes() {
  return {{"cube", cube(4), 2},
          {"bricks", box_of(3, 0, 5, 0, 0, 8), 2},
          {"skewed", box_of(4, 2, 4, -1.7F, 1.3F, 4), 4},
          {"very skewed", box_of(4, 11, 4, 9, -7, 4), 8},
          {"turned", {.vector = {{2, 3, 1}, {-3, 2, 1}, {0.5F, -1, 4}}}, 4},
          {"left-handed", {.vector = {{0, 4, 0}, {4, 0, 0}, {0, 0, 4}}}, 2},
          {"thin", box_of(6, 0, 6, 0, 0, 0.3F), 9},
          {"tiny", cube(0.6F), 6}};
}

TEST(Images, EveryKindOfBoxIsExact) {
  for (const auto& [name, box, most] : boxes()) {
    for (int axes = 1; axes < (kSanitized ? 3 : 8); ++axes) {
      Random random(static_cast<std::uint64_t>(axes));
      Box some = box;
      for (int a = 0; a < 3; ++a) some.periodic[a] = (axes >> a & 1) != 0;
      const int n = most > 4 ? 4 : 10;
      const std::vector<Sphere> spheres = in_box(random, n, box, 0, 0.9);
      SCOPED_TRACE(fmt::format("{}, axes {}", name, axes));
      expect_found(spheres, {.box = some}, all_by_trying(spheres, some, most + 2));
    }
  }
}

TEST(Images, SearchesAreExactAsComparisonsAre) {
  // Enough spheres that they are sorted into a grid; truth for a sample of them.
  for (const Box& box : {cube(30), box_of(30, 9, 28, -8, 5, 26)}) {
    Random random(5);
    const int n = kSanitized ? 1000 : 3000;
    const std::vector<Sphere> spheres = in_box(random, n, box, 0.2, 0.6);
    const List all = found(spheres, {.threads = 2, .box = box});
    for (std::uint32_t i = 0; i < 6; ++i) {
      List of_i;
      for (const ImagePair& p : all) {
        if (p.pair.i == i) of_i.push_back(p);
      }
      List expected;
      for (std::uint32_t j = i; j < spheres.size(); ++j) {
        const Sphere two[] = {spheres[i], spheres[j]};
        for (const ImagePair& p : all_by_trying(two, box, 1)) {
          const bool own = p.pair.i == p.pair.j;
          if (own ? (p.pair.i == 0 && j == i) : j != i) expected.push_back({{i, j}, p.shift});
        }
      }
      EXPECT_EQ(text_of(of_i), text_of(expected)) << i;
    }
  }
}

TEST(Images, SpheresNeedNotLieInTheBox) {
  Random random(9);
  const Box box = box_of(4, 1, 4, 0.5F, -1, 4);
  std::vector<Sphere> spheres = in_box(random, 12, box, 0.3, 1);
  for (const int far : {1, 3, 1000, 1 << 20}) {
    std::vector<Sphere> moved = spheres;
    std::vector<Shift> homes;
    for (Sphere& s : moved) {
      const Shift by = {random.below(2 * far + 1) - far, random.below(2 * far + 1) - far,
                        random.below(2 * far + 1) - far};
      s.x = static_cast<float>(s.x + by.a * 4.0 + by.b * 1.0 + by.c * 0.5);
      s.y = static_cast<float>(s.y + by.b * 4.0 - by.c * 1.0);
      s.z = static_cast<float>(s.z + by.c * 4.0);
      homes.push_back({-by.a, -by.b, -by.c});
    }
    SCOPED_TRACE(far);
    expect_found(moved, {.box = box}, all_by_trying(moved, box, 4, 0.0, homes));
  }
}

TEST(Images, WhatTouchesAcrossABorderIsEnclosedAndThenDecided) {
  // Image positions need more digits than float32 has, and radii leave no room for that.
  Random random(21);
  for (int k = 0; k < 200; ++k) {
    const Box box = cube(static_cast<float>(random.real(9, 11)));
    Sphere p = {static_cast<float>(random.real(0, 1)), 5, 5, 0};
    Sphere q = {static_cast<float>(random.real(8, 8.9)), 5, 5, 0};
    const double distance = static_cast<double>(p.x) + box.vector[0][0] - q.x;  // exact
    p.r = static_cast<float>(distance);
    if (p.r >= distance) p.r = std::nextafter(p.r, 0.0F);
    q.r = static_cast<float>(distance - p.r);  // exact
    const List touching = {{{0, 1}, {1, 0, 0}}};
    expect_either_way(std::vector<Sphere>{p, q}, {.box = box}, touching);
    q.r = std::nextafter(q.r, 0.0F);
    expect_either_way(std::vector<Sphere>{p, q}, {.box = box}, {});
  }
}

TEST(Images, ALatticeInItsOwnCellTouchesAcrossEveryBorder) {
  for (const int side : {1, 2, 5, 16}) {
    std::vector<Sphere> spheres;
    for (int k = 0; k < side * side * side; ++k) {
      spheres.push_back({static_cast<float>(k % side), static_cast<float>(k / side % side),
                         static_cast<float>(k / side / side), 0.5F});
    }
    const auto n = static_cast<std::uint64_t>(spheres.size());
    EXPECT_EQ(count(spheres, {.box = cube(static_cast<float>(side))}), 3 * n) << side;
    Box wider = cube(static_cast<float>(side));
    wider.vector[0][0] = std::nextafter(wider.vector[0][0], 1e9F);
    EXPECT_EQ(count(spheres, {.box = wider}), 3 * n - n / static_cast<std::uint64_t>(side));
  }
}

TEST(Images, CutoffsAreAddedOverTheReals) {
  // 1 + 1 + cutoff = 3 - 2^-40, and 3: float32 and float32 sums would call both the same.
  const std::vector<Sphere> spheres = {{0, 0, 0, 1}, {3, 0, 0, 1}};
  EXPECT_EQ(count(spheres, {.cutoff = 1.0 - 0x1p-40}), 0U);
  EXPECT_EQ(count(spheres, {.cutoff = 1.0}), 1U);
  Random random(3);
  const Box box = box_of(3, 1, 3, 0, 1, 3);
  const std::vector<Sphere> some = in_box(random, 10, box, 0, 0.4);
  for (const double cutoff : {0x1p-149, 0.1, 1.3}) {
    expect_found(some, {.box = box, .cutoff = cutoff}, all_by_trying(some, box, 4, cutoff));
  }
  const Box open = {.vector = {}, .periodic = {false, false, false}};
  const std::vector<Sphere> many = in_box(random, 1000, cube(14), 0, 0.1);
  EXPECT_EQ(count(many, {.cutoff = 0.5}), all_by_trying(many, open, 0, 0.5).size());
}

TEST(Images, FlagsCountForImages) {
  Random random(4);
  const Box box = cube(3);
  const std::vector<Sphere> spheres = in_box(random, 12, box, 0.3, 1);
  std::vector<Flags> flags;
  for (int i = 0; i < 12; ++i) {
    flags.push_back(make_flags(i % 3 == 0, i % 2 == 0 ? 1 : 2, i % 4 == 0 ? 2 : 3));
  }
  List expected;
  for (const ImagePair& p : all_by_trying(spheres, box, 3)) {
    const auto static_of = [&](std::uint32_t i) { return (flags[i].word >> 15 & 1U) != 0; };
    const auto lets = [&](std::uint32_t i, std::uint32_t j) {
      return ((flags[i].word & kMaxGroup) & flags[j].word >> 16) != 0;
    };
    const auto [i, j] = p.pair;
    if (!(static_of(i) && static_of(j)) && lets(i, j) && lets(j, i)) expected.push_back(p);
  }
  ASSERT_FALSE(expected.empty());
  expect_found(spheres, {.flags = flags, .box = box}, expected);
}

TEST(Images, AnyScaleIsExact) {
  for (const float scale : {0x1p-140F, 0x1p-60F, 0x1p60F, 0x1p124F}) {
    Random random(8);
    const Box box = box_of(2, 0.5F, 2, 0.25F, 0.5F, 2);
    Box scaled = box;
    for (auto& vector : scaled.vector) {
      for (float& x : vector) x *= scale;
    }
    std::vector<Sphere> spheres = in_box(random, 8, box, 0.2, 0.8);
    for (Sphere& s : spheres) s = {s.x * scale, s.y * scale, s.z * scale, s.r * scale};
    SCOPED_TRACE(scale);
    expect_found(spheres, {.box = scaled}, all_by_trying(spheres, scaled, 4));
  }
}

std::string error_of(const Box& box, std::span<const Sphere> spheres, ErrorKind kind) {
  try {
    count(spheres, {.box = box});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "none";
}

TEST(Images, BoxesThatCannotBeUsedAreRefused) {
  const std::vector<Sphere> one = {{0, 0, 0, 1}};
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const std::vector<Sphere> point = {{0, 0, 0, 0}};
  const auto bad = ErrorKind::invalid_argument;
  EXPECT_EQ(error_of(box_of(1, 0, kInf, 0, 0, 1), one, bad),
            "box: vector b is (0, inf, 0); its numbers must be finite");
  const std::string flat =
      "box: its periodic vectors are zero, or lie in one plane or on one line, or nearly so";
  EXPECT_EQ(error_of(cube(0), one, bad), flat);
  EXPECT_EQ(error_of({.vector = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}}, one, bad), flat);
  EXPECT_EQ(error_of({.vector = {{0.1F, 0.7F, 0}, {0.3F, 2.1F, 0}, {0, 0, 1}}}, point, bad),
            "none");
  EXPECT_EQ(
      error_of({.vector = {{1, 1, 0}, {2, 2, 0}, {kInf, 0, 0}}, .periodic = {true, true, false}},
               one, bad),
      flat);
  EXPECT_EQ(
      error_of({.vector = {{9, 0, 0}, {kInf, 0, 0}, {0, 0, 0}}, .periodic = {true, false, false}},
               one, bad),
      "none");
}

TEST(Images, TooManyImagesAreRefusedWithTheirNumber) {
  const std::vector<Sphere> one = {{0, 0, 0, 1e6F}};
  EXPECT_EQ(
      error_of(cube(1), one, ErrorKind::limit),
      "box: about 6.4e+19 pairs of images are near each other; this implementation's limit is "
      "4.4e+12");
  const std::vector<Sphere> two = {{0, 0, 0, 1}, {1e20F, 0, 0, 1}};
  EXPECT_EQ(error_of(cube(10), two, ErrorKind::limit),
            "box: the spheres lie 1e+19 boxes apart along vector a; this implementation's limit is "
            "536870912");
}

TEST(Images, InvalidSpheresAndCutoffsAreNamed) {
  const std::vector<Sphere> spheres = {{0, 0, 0, 1}, {0, 0, 0, -1}};
  try {
    find_pairs(spheres, {.box = cube(3)});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.sphere(), 1U);
  }
  EXPECT_THROW(count({}, {.cutoff = -1.0}), Error);
  EXPECT_THROW(count({}, {.cutoff = std::numeric_limits<double>::infinity()}), Error);
  EXPECT_EQ(count({}, {.box = cube(3)}), 0U);
}

}  // namespace
}  // namespace octocell
