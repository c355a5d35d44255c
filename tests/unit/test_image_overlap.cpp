// SPDX-License-Identifier: MIT
// The exact test of two images, where it is most difficult, against rational numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "core/images/image_overlap.hpp"
#include "include/octocell/octocell.hpp"
#include "tests/support/image_pairs.hpp"
#include "tests/support/sanitized.hpp"

namespace octocell {
namespace {

using namespace image_tests;

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

TEST(ImageOverlap, NearTangentPairsAreDecidedAsByRationalNumbers) {
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

TEST(ImageOverlap, NearTangentPairsAreDecidedInFloat64AsByIntegers) {
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

TEST(ImageOverlap, IntegersHoldTheLargestAndTheSmallestNumbers) {
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
