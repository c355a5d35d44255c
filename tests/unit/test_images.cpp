// SPDX-License-Identifier: MIT
// Boxes that repeat, and cutoffs: the pairs of images, against rational numbers and all shifts.
#include <fmt/format.h>
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/flags.hpp"
#include "core/images/image_overlap.hpp"
#include "harness/engine/images/find_images.hpp"
#include "include/octocell/octocell.hpp"
#include "tests/support/sanitized.hpp"

namespace octocell {
namespace {

struct ImagePair {
  Pair pair;
  Shift shift;
  friend auto operator<=>(const ImagePair&, const ImagePair&) = default;
};
using List = std::vector<ImagePair>;

std::string text_of(const List& list) {
  std::string text;
  for (const auto& [p, s] : list) {
    text += fmt::format("({}, {}; {}, {}, {}) ", p.i, p.j, s.a, s.b, s.c);
  }
  return text;
}

/// |p_i - p_j + S H|^2 <= (r_i + r_j + gap)^2, in rational numbers.
bool truth(const Sphere& p, const Sphere& q, const Shift& shift, const Box& box, double gap) {
  const float from[] = {p.x, p.y, p.z};
  const float to[] = {q.x, q.y, q.z};
  const std::int32_t steps[] = {shift.a, shift.b, shift.c};
  mpq_class distance2 = 0;
  for (int k = 0; k < 3; ++k) {
    mpq_class along = mpq_class(from[k]) - mpq_class(to[k]);
    for (int a = 0; a < 3; ++a) {
      if (steps[a] != 0) along += steps[a] * mpq_class(box.vector[a][k]);
    }
    distance2 += along * along;
  }
  const mpq_class reach = mpq_class(p.r) + mpq_class(q.r) + mpq_class(gap);
  return distance2 <= reach * reach;
}

bool first_is_positive(const Shift& s) { return s > Shift{0, 0, 0}; }

/// The same; float64 decides what is far from touching, whatever it rounds.
bool overlaps(const Sphere& p, const Sphere& q, const Shift& shift, const Box& box, double gap) {
  const float from[] = {p.x, p.y, p.z};
  const float to[] = {q.x, q.y, q.z};
  const std::int32_t steps[] = {shift.a, shift.b, shift.c};
  double distance2 = 0.0;
  double size = 0.0;
  for (int k = 0; k < 3; ++k) {
    double along = static_cast<double>(from[k]) - to[k];
    size += std::abs(from[k]) + std::abs(to[k]);
    for (int a = 0; a < 3; ++a) {
      if (steps[a] == 0) continue;
      along += steps[a] * static_cast<double>(box.vector[a][k]);
      size += std::abs(steps[a] * static_cast<double>(box.vector[a][k]));
    }
    distance2 += along * along;
  }
  const double distance = std::sqrt(distance2);
  const double reach = static_cast<double>(p.r) + q.r + gap;
  if (std::abs(distance - reach) > 1e-9 * (size + reach)) return distance < reach;
  return truth(p, q, shift, box, gap);
}

/// All pairs, by trying all shifts from -most to most of each periodic axis, around `near`.
List all_by_trying(std::span<const Sphere> spheres, const Box& box, int most, double gap = 0.0,
                   std::span<const Shift> homes = {}) {
  List all;
  const int m[] = {box.periodic[0] ? most : 0, box.periodic[1] ? most : 0,
                   box.periodic[2] ? most : 0};
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    for (std::uint32_t j = i; j < spheres.size(); ++j) {
      const Shift around = homes.empty() ? Shift{0, 0, 0}
                                         : Shift{homes[i].a - homes[j].a, homes[i].b - homes[j].b,
                                                 homes[i].c - homes[j].c};
      for (int a = -m[0]; a <= m[0]; ++a) {
        for (int b = -m[1]; b <= m[1]; ++b) {
          for (int c = -m[2]; c <= m[2]; ++c) {
            const Shift s = {around.a + a, around.b + b, around.c + c};
            if (i == j && !first_is_positive(s)) continue;
            if (overlaps(spheres[i], spheres[j], s, box, gap)) all.push_back({{i, j}, s});
          }
        }
      }
    }
  }
  std::ranges::sort(all);
  return all;
}

List listed(std::span<const Pair> pairs, std::span<const Shift> shifts) {
  EXPECT_EQ(pairs.size(), shifts.size());
  List list;
  for (std::size_t k = 0; k < std::min(pairs.size(), shifts.size()); ++k) {
    list.push_back({pairs[k], shifts[k]});
  }
  return list;
}

List found(std::span<const Sphere> spheres, const Options& options) {
  const Pairs pairs = find_pairs(spheres, options);
  return listed({pairs.data(), pairs.size()}, pairs.shifts());
}

/// Finds the overlapping pairs of a scene in open space, by rational numbers.
OwnedPairs by_definition(SceneView scene) {
  const Box open = {.vector = {}, .periodic = {false, false, false}};
  std::vector<Pair> list;
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    for (std::uint32_t j = i + 1; j < scene.spheres.size(); ++j) {
      const bool may = scene.flags.empty() || may_collide(scene.flags[i], scene.flags[j]);
      if (may && overlaps(scene.spheres[i], scene.spheres[j], {0, 0, 0}, open, 0.0)) {
        list.push_back({i, j});
      }
    }
  }
  OwnedPairs owned;
  owned.items.allocate(list.size());
  owned.count = list.size();
  std::ranges::copy(list, owned.items.data());
  return owned;
}

/// Both ways, whichever the estimate would choose.
void expect_either_way(std::span<const Sphere> spheres, const Options& options,
                       const List& expected) {
  images::Question question = {.scene = {spheres, options.flags}, .gap = options.cutoff};
  if (options.box) question.box = *options.box;
  images::ImageFinder finder(2);
  for (const images::Way way : {images::Way::search, images::Way::compare}) {
    const images::ImagePairs pairs = finder.find(question, {.way = way}, by_definition);
    const List list = listed({pairs.pairs.items.data(), pairs.pairs.count},
                             {pairs.shifts.data(), pairs.pairs.count});
    EXPECT_EQ(text_of(list), text_of(expected)) << static_cast<int>(way);
  }
}

void expect_found(std::span<const Sphere> spheres, const Options& options, const List& expected) {
  EXPECT_EQ(text_of(found(spheres, options)), text_of(expected));
  EXPECT_EQ(count(spheres, options), expected.size());
  expect_either_way(spheres, options, expected);
  Options unsorted = options;
  unsorted.sorted = false;
  List any = found(spheres, unsorted);
  std::ranges::sort(any);
  EXPECT_TRUE(any == expected);
  Finder finder(options);
  for (int frame = 0; frame < 2; ++frame) {
    const auto pairs = finder.find(spheres);
    EXPECT_TRUE(listed(pairs, finder.shifts()) == expected);
  }
  const Pairs taken = finder.take();
  EXPECT_TRUE(listed({taken.data(), taken.size()}, taken.shifts()) == expected);
}

Box box_of(float ax, float bx, float by, float cx, float cy, float cz) {
  return {.vector = {{ax, 0, 0}, {bx, by, 0}, {cx, cy, cz}}};
}
Box cube(float side) { return box_of(side, 0, side, 0, 0, side); }

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double real(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  int below(int end) { return static_cast<int>(bits_() % static_cast<std::uint64_t>(end)); }

 private:
  std::mt19937_64 bits_;
};

std::vector<Sphere> in_box(Random& random, int n, const Box& box, double r_least, double r_most) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < n; ++i) {
    double at[3] = {0, 0, 0};
    for (const auto& vector : box.vector) {
      const double along = random.real(0, 1);
      for (int k = 0; k < 3; ++k) at[k] += along * vector[k];
    }
    spheres.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]),
                       static_cast<float>(at[2]),
                       static_cast<float>(random.real(r_least, r_most))});
  }
  return spheres;
}

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

/// A random case that is as near to touching as float32 can make it.
ImageTest near_tangent(Random& random, Box& box) {
  const double scale = std::ldexp(1.0, random.below(40) - 20);
  for (auto& vector : box.vector) {
    for (float& x : vector) x = static_cast<float>(random.real(-1, 1) * scale);
  }
  ImageTest t = {};
  // With the last, products and sums lose digits in float64.
  const int most[] = {3, 1 << 20, 1 << 29};
  const int m = most[random.below(3)];
  t.shift = {random.below(2 * m) - m, random.below(2 * m) - m, random.below(2 * m) - m};
  const double d[] = {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
  double at[3];
  const std::int32_t steps[] = {t.shift.a, t.shift.b, t.shift.c};
  const auto place = [&] { return static_cast<float>(random.real(-2, 2) * scale); };
  t.p = {place(), place(), place(), 0};
  const float from[] = {t.p.x, t.p.y, t.p.z};
  for (int k = 0; k < 3; ++k) {
    at[k] = from[k] + d[k] * scale;
    for (int a = 0; a < 3; ++a) at[k] += steps[a] * static_cast<double>(box.vector[a][k]);
  }
  t.q = {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]), 0};
  const float to[] = {t.q.x, t.q.y, t.q.z};
  double distance2 = 0.0;
  for (int k = 0; k < 3; ++k) {
    double along = static_cast<double>(from[k]) - to[k];
    for (int a = 0; a < 3; ++a) along += steps[a] * static_cast<double>(box.vector[a][k]);
    distance2 += along * along;
  }
  const double distance = std::sqrt(distance2);
  t.p.r = static_cast<float>(distance * random.real(0, 1));
  t.q.r = std::max(0.0F, static_cast<float>(distance - t.p.r));
  if (random.below(2) == 0) {
    t.q.r = std::nextafter(t.q.r, 0.0F);
    t.gap = std::max(0.0, (distance - t.p.r) - t.q.r);
    if (t.gap < kLeastGap) t.gap = 0.0;
  }
  return t;
}

TEST(Images, NearTangentPairsAreDecidedAsByRationalNumbers) {
  Random random(11);
  int overlaps = 0;
  int uncertain = 0;
  const int tries = kSanitized ? 5'000 : 50'000;
  for (int k = 0; k < tries; ++k) {
    Box box = {};
    const ImageTest t = near_tangent(random, box);
    const bool expected = truth(t.p, t.q, t.shift, box, t.gap);
    overlaps += expected ? 1 : 0;
    const Verdict verdict = exact::image_float64_test(t, box);
    uncertain += verdict == Verdict::uncertain ? 1 : 0;
    if (verdict != Verdict::uncertain) {
      ASSERT_EQ(verdict == Verdict::overlap, expected) << k;
    }
    ASSERT_EQ(exact::image_integer_test(t, box), expected) << k;
  }
  // Both answers and both levels occur.
  EXPECT_GT(overlaps, tries / 10);
  EXPECT_LT(overlaps, tries - tries / 10);
  EXPECT_GT(uncertain, tries / 20);
  EXPECT_LT(uncertain, tries);
}

/// How many near-tangent pairs are tried; a long run sets OCTOCELL_NEAR_TANGENT.
long near_tangent_pairs() {
  const char* const given = std::getenv("OCTOCELL_NEAR_TANGENT");
  return given != nullptr ? static_cast<long>(std::strtoull(given, nullptr, 10))
         : kSanitized     ? 20'000
                          : 300'000;
}

TEST(Images, NearTangentPairsAreDecidedInFloat64AsByIntegers) {
  Random random(13);
  const long tries = near_tangent_pairs();
  long decided = 0;
  for (long k = 0; k < tries; ++k) {
    Box box = {};
    const ImageTest t = near_tangent(random, box);
    const Verdict verdict = exact::image_float64_test(t, box);
    if (verdict == Verdict::uncertain) continue;
    ++decided;
    ASSERT_EQ(verdict == Verdict::overlap, exact::image_integer_test(t, box)) << k;
  }
  EXPECT_GT(decided, tries / 3);
}

TEST(Images, IntegersHoldTheLargestAndTheSmallestNumbers) {
  constexpr float kMax = std::numeric_limits<float>::max();
  constexpr float kMin = std::numeric_limits<float>::denorm_min();
  constexpr std::int32_t kSteps = std::numeric_limits<std::int32_t>::max();
  const float values[] = {0, kMin, -kMin, 1, -1, kMax, -kMax};
  Random random(12);
  const auto any = [&] { return values[random.below(7)]; };
  const std::int32_t steps[] = {0, 1, -1, kSteps, -kSteps - 1};
  for (int k = 0; k < 20'000; ++k) {
    const Box box = {
        .vector = {{any(), any(), any()}, {any(), any(), any()}, {any(), any(), any()}}};
    const double gaps[] = {0.0, kLeastGap, 1.0 + 0x1p-52, kMax, std::nextafter(kLeastGap, 1.0)};
    const ImageTest t = {
        .p = {any(), any(), any(), std::abs(any())},
        .q = {any(), any(), any(), std::abs(any())},
        .shift = {steps[random.below(5)], steps[random.below(5)], steps[random.below(5)]},
        .gap = gaps[random.below(5)]};
    const bool expected = truth(t.p, t.q, t.shift, box, t.gap);
    ASSERT_EQ(exact::image_integer_test(t, box), expected) << k;
    ASSERT_EQ(images_overlap(t, box), expected) << k;
  }
}

}  // namespace
}  // namespace octocell
