// SPDX-License-Identifier: MIT
// Pairs of images by other means: rational numbers, and all shifts tried.
#pragma once

#include <fmt/format.h>
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/flags.hpp"
#include "harness/engine/images/find_images.hpp"
#include "include/octocell/octocell.hpp"

namespace octocell::image_tests {

struct ImagePair {
  Pair pair;
  Shift shift;
  friend auto operator<=>(const ImagePair&, const ImagePair&) = default;
};
using List = std::vector<ImagePair>;

inline std::string text_of(const List& list) {
  std::string text;
  for (const auto& [p, s] : list) {
    text += fmt::format("({}, {}; {}, {}, {}) ", p.i, p.j, s.a, s.b, s.c);
  }
  return text;
}

/// |p_i - p_j + S H|^2 <= (r_i + r_j + gap)^2, in rational numbers.
inline bool truth(const Sphere& p, const Sphere& q, const Shift& shift, const Box& box,
                  double gap) {
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

inline bool first_is_positive(const Shift& s) { return s > Shift{0, 0, 0}; }

/// The same; float64 decides what is far from touching, whatever it rounds.
inline bool overlaps(const Sphere& p, const Sphere& q, const Shift& shift, const Box& box,
                     double gap) {
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
inline List all_by_trying(std::span<const Sphere> spheres, const Box& box, int most,
                          double gap = 0.0, std::span<const Shift> homes = {}) {
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

inline List listed(std::span<const Pair> pairs, std::span<const Shift> shifts) {
  EXPECT_EQ(pairs.size(), shifts.size());
  List list;
  for (std::size_t k = 0; k < std::min(pairs.size(), shifts.size()); ++k) {
    list.push_back({pairs[k], shifts[k]});
  }
  return list;
}

inline List found(std::span<const Sphere> spheres, const Options& options) {
  const Pairs pairs = find_pairs(spheres, options);
  return listed({pairs.data(), pairs.size()}, pairs.shifts());
}

/// Finds the overlapping pairs of a scene in open space, by rational numbers.
inline OwnedPairs by_definition(SceneView scene) {
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
inline void expect_either_way(std::span<const Sphere> spheres, const Options& options,
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

inline void expect_found(std::span<const Sphere> spheres, const Options& options,
                         const List& expected) {
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

inline Box box_of(float ax, float bx, float by, float cx, float cy, float cz) {
  return {.vector = {{ax, 0, 0}, {bx, by, 0}, {cx, cy, cz}}};
}
inline Box cube(float side) { return box_of(side, 0, side, 0, 0, side); }

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

inline std::vector<Sphere> in_box(Random& random, int n, const Box& box, double r_least,
                                  double r_most) {
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

}  // namespace octocell::image_tests
