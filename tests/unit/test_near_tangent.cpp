// SPDX-License-Identifier: MIT
// The second reference agrees with the first, its pairs are what their families promise, and the
// predicate is right about them.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "harness/verify/near_tangent/near_tangent.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::near_tangent {
namespace {

class Families : public testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] Family family() const { return static_cast<Family>(GetParam()); }
};

TEST_P(Families, AreJudgedAlikeByBothOracles) {
  int overlaps = 0;
  constexpr int kPairs = 20'000;
  for (std::uint64_t number = 0; number < kPairs; ++number) {
    const Two two = make(family(), number);
    const bool truth = reference::overlap(two.a, two.b);
    ASSERT_EQ(overlap(two.a, two.b), truth) << number;
    overlaps += truth ? 1 : 0;
  }
  EXPECT_GT(overlaps, kPairs / 10);
  EXPECT_LT(overlaps, kPairs - kPairs / 10);
}

TEST_P(Families, AreNearTangentThatFloat32IsOftenWrongAbout) {
  const Tally tally = try_on_host(family(), 0, 100'000, 2);
  EXPECT_EQ(tally.tried, 100'000U);
  EXPECT_GT(tally.near, tally.tried / 20);
  EXPECT_GT(tally.float32_wrong, 100U);
  EXPECT_EQ(tally.mismatches, 0U) << "the first is " << tally.first_wrong;
}

/// Of the first 200,000: a compiler that keeps a double where the code says float makes others.
TEST_P(Families, AreTheSameOnEveryMachine) {
  struct Counts {
    std::uint64_t near;
    std::uint64_t float32_wrong;
  };
  constexpr Counts kCounts[] = {{200'000, 3'818},  {199'947, 3'621},  {193'694, 49'594},
                                {200'000, 26'092}, {200'000, 13'214}, {31'149, 2'131}};
  const Tally tally = try_on_host(family(), 0, 200'000, 2);
  EXPECT_EQ(tally.near, kCounts[GetParam()].near);
  EXPECT_EQ(tally.float32_wrong, kCounts[GetParam()].float32_wrong);
}

TEST_P(Families, AreTheSameHoweverTheyAreShared) {
  const Tally one = try_on_host(family(), 1000, 11'001, 1);
  const Tally three = try_on_host(family(), 1000, 11'001, 3);
  EXPECT_EQ(one.tried, 10'001U);
  EXPECT_EQ(one.near, three.near);
  EXPECT_EQ(one.float32_wrong, three.float32_wrong);
}

TEST_P(Families, AreTheSameOnADevice) {
  if (const auto reason = why_no_device()) GTEST_SKIP() << *reason;
  const Tally host = try_on_host(family(), 0, 200'000, 2);
  const Tally device = try_on_device(family(), 0, 200'000);
  EXPECT_EQ(device.tried, host.tried);
  EXPECT_EQ(device.near, host.near);
  EXPECT_EQ(device.mismatches, 0U);
  EXPECT_EQ(device.float32_wrong, host.float32_wrong);
}

INSTANTIATE_TEST_SUITE_P(All, Families, testing::Range(std::size_t{0}, kFamilyNames.size()),
                         [](const auto& family) {
                           return std::string(kFamilyNames[family.param]);
                         });

TEST(ColumnOracle, KnowsTheEndsOfFloat32) {
  constexpr float kMost = std::numeric_limits<float>::max();
  constexpr float kLeast = std::numeric_limits<float>::denorm_min();
  const Sphere special[] = {{0, 0, 0, 0},
                            {-0.0F, 0, 0, kLeast},
                            {kLeast, -kLeast, 0, kLeast},
                            {kMost, kMost, kMost, kMost},
                            {-kMost, -kMost, -kMost, kMost},
                            {-kMost, 0, 0, 0},
                            {1, 0, 0, 0x1.fffffep-1F},
                            {0, 3, 4, 5},
                            {0x1p-126F, 0, 0, kMost}};
  for (const Sphere& a : special) {
    for (const Sphere& b : special) {
      EXPECT_EQ(overlap(a, b), reference::overlap(a, b))
          << a.x << " " << a.r << " and " << b.x << " " << b.r;
    }
  }
}

/// A sum of many products of one sign stays within a column.
TEST(ColumnOracle, CarriesAndBorrowsThroughAllColumns) {
  ColumnSum sum;
  const Parts most = parts_of(std::numeric_limits<float>::max());
  const Parts least = parts_of(std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(sum.sign(), 0);
  sum.add(2, most, most);
  sum.add(-1, least, least);
  EXPECT_EQ(sum.sign(), 1);
  sum.add(-2, most, most);
  EXPECT_EQ(sum.sign(), -1);
  sum.add(1, least, least);
  EXPECT_EQ(sum.sign(), 0);
}

}  // namespace
}  // namespace octocell::near_tangent
