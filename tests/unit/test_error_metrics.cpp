// SPDX-License-Identifier: MIT
// How wrong an answer is, on scenes whose distances are known by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {
namespace {

constexpr Sphere at(float x, float r) { return {x, 0, 0, r}; }

/// s = r_p + r_q; the gap is dist - s.
TEST(RelativeDepth, IsWhatIsLeftOfTheReach) {
  EXPECT_EQ(relative_depth(at(0, 1), at(0, 3)), 1.0);   // one centre
  EXPECT_EQ(relative_depth(at(0, 1), at(1, 1)), 0.5);   // s = 2, distance 1
  EXPECT_EQ(relative_depth(at(0, 1), at(2, 1)), 0.0);   // they touch
  EXPECT_EQ(relative_depth(at(0, 1), at(3, 1)), -0.5);  // 1 apart
  EXPECT_EQ(relative_depth({0, 0, 0, 1}, {3, 4, 12, 12}), 0.0);
  EXPECT_EQ(relative_depth({0, 0, 0, 1}, {3, 4, 12, 25}), 0.5);
}

TEST(RelativeDepth, IsNeverRoundedToZero) {
  for (const int exponent : {-24, -30, -60, -140}) {
    const float little = std::ldexp(1.0F, exponent);
    const double expected = little / (1.0 + static_cast<double>(little));
    EXPECT_DOUBLE_EQ(relative_depth(at(0, 1), at(1, little)), expected) << exponent;
  }
  // 1 apart from contact by the last place of 2^-149, at a reach of 2^127.
  const Sphere large = {0, 0, 0, 0x1p127F};
  EXPECT_DOUBLE_EQ(relative_depth(large, {0x1p127F, 0, 0, 0x1p-149F}), 0x1p-276);
  EXPECT_DOUBLE_EQ(relative_depth(large, {0x1p127F, 0x1p-149F, 0, 0}), -0x1p-553);
}

TEST(RelativeDepth, OfPointsApartIsTheLeastNumber) {
  EXPECT_EQ(relative_depth(at(1, 0), at(1, 0)), 0.0);
  EXPECT_EQ(relative_depth(at(0, 0), at(0x1p-149F, 0)), std::numeric_limits<double>::lowest());
}

/// A row of spheres: 0 and 1 overlap by half of their reach, 1 and 2 by 2^-30 of it, 3 touches 4.
const std::vector<Sphere> kRow = {at(-1, 1), at(0, 1), at(1 + 0, 0x1p-30F), at(10, 1), at(12, 1)};
const std::vector<Pair> kTruth = {{0, 1}, {1, 2}, {3, 4}};

TEST(Comparison, TheSceneIsAsItsCommentSays) { EXPECT_EQ(exact_pairs(kRow), kTruth); }

TEST(Comparison, TellsTheDeepestOfTheMissedPairs) {
  const auto worst = [](std::vector<Pair> answer) {
    return compare(answer, kTruth, kRow).worst_missed_depth;
  };
  EXPECT_EQ(worst({}), 0.5);
  EXPECT_DOUBLE_EQ(worst({{0, 1}}).value(), 0x1p-30 / (1 + 0x1p-30));
  EXPECT_EQ(worst({{0, 1}, {1, 2}}), 0.0);  // missed, and only touching
  EXPECT_FALSE(worst(kTruth).has_value());
}

TEST(Comparison, TellsTheFarthestOfTheFalsePairs) {
  const auto worst = [](std::vector<Pair> answer) {
    return compare(answer, kTruth, kRow).worst_false_gap;
  };
  EXPECT_DOUBLE_EQ(worst({{0, 1}, {0, 2}, {1, 2}, {3, 4}}).value(), (1 - 0x1p-30) / (1 + 0x1p-30));
  EXPECT_EQ(worst({{0, 1}, {0, 2}, {0, 3}, {1, 2}, {3, 4}}), 4.5);  // 11 apart, 2 in reach
  EXPECT_FALSE(worst({}).has_value());
}

TEST(Comparison, WithoutSpheresCountsOnly) {
  const Comparison difference = compare(std::vector<Pair>{{0, 2}}, kTruth);
  EXPECT_EQ(difference.missed, 3U);
  EXPECT_EQ(difference.false_pairs, 1U);
  EXPECT_FALSE(difference.worst_missed_depth.has_value());
  EXPECT_FALSE(difference.worst_false_gap.has_value());
}

TEST(RoundingEffect, CountsPairsLostAndGained) {
  const double above = 1 + 0x1p-30;    // rounds to 1
  const double grown = 0.5 + 0x1p-26;  // rounds to 0.5
  const std::vector<DoubleSphere> world = {{0, 0, 0, 0.5},
                                           {above, 0, 0, 0.5},  // apart, then they touch
                                           {0, 10, 0, 0.5},
                                           {0, 10, above, 0.5},  // the same
                                           {-0x1p-25, 20, 0, grown},
                                           {1, 20, 0, grown},  // touch, then they are apart
                                           {0, 30, 0, 1},
                                           {0, 31, 0, 1}};  // overlap throughout
  std::vector<Sphere> scene;
  for (const DoubleSphere& s : world) scene.push_back(rounded(s));
  const RoundingEffect effect = rounding_effect(world, {}, exact_pairs(scene));
  EXPECT_EQ(effect.lost, 1U);
  EXPECT_EQ(effect.gained, 2U);
  const std::vector<Flags> still(world.size(), make_flags(true, 1, kMaxMask));
  const RoundingEffect none = rounding_effect(world, still, exact_pairs(scene, still));
  EXPECT_EQ(none.lost + none.gained, 0U);
}

}  // namespace
}  // namespace octocell::reference
