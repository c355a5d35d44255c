// SPDX-License-Identifier: MIT
// Compares the three levels with big integers, on families made to break them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>

#include "core/overlap.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell {
namespace {

struct Two {
  Sphere a;
  Sphere b;
};

class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  float any_finite() {
    for (;;) {
      const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
      if (std::isfinite(value)) return value;
    }
  }

  Two random_bits() {
    return {{any_finite(), any_finite(), any_finite(), std::fabs(any_finite())},
            {any_finite(), any_finite(), any_finite(), std::fabs(any_finite())}};
  }

  /// b is placed so that it is tangent to a up to rounding, at any scale and offset.
  Two near_tangent(int low_exponent, int high_exponent, double offset) {
    const double scale =
        std::ldexp(uniform(1, 2), static_cast<int>(uniform(low_exponent, high_exponent)));
    const auto value = [&](double v) { return static_cast<float>(v * scale); };
    Two two;
    two.a = {value(uniform(-1, 1) + offset), value(uniform(-1, 1)), value(uniform(-1, 1)),
             value(uniform(0, 1))};
    two.b.r = value(uniform(0, 1));
    const double radius_sum = static_cast<double>(two.a.r) + two.b.r;
    const double u = uniform(-1, 1);
    const double phi = uniform(0, 6.283185307179586);
    const double s = std::sqrt(1 - u * u);
    two.b.x = static_cast<float>(two.a.x + radius_sum * s * std::cos(phi));
    two.b.y = static_cast<float>(two.a.y + radius_sum * s * std::sin(phi));
    two.b.z = static_cast<float>(two.a.z + radius_sum * u);
    return two;
  }

  /// Exact ties from integer quadruples, with single-ulp nudges.
  Two pythagorean() {
    static constexpr int kQuadruples[][4] = {{1, 2, 2, 3},   {2, 3, 6, 7},   {1, 4, 8, 9},
                                             {4, 4, 7, 9},   {2, 6, 9, 11},  {6, 6, 7, 11},
                                             {3, 4, 12, 13}, {2, 5, 14, 15}, {0, 3, 4, 5}};
    const auto& q = kQuadruples[random_() % std::size(kQuadruples)];
    const float scale = std::ldexp(1.0F, static_cast<int>(random_() % 160) - 80);
    const float part = static_cast<float>(random_() % static_cast<unsigned>(q[3] + 1));
    Two two = {{0, 0, 0, part * scale},
               {static_cast<float>(q[0]) * scale, static_cast<float>(q[1]) * scale,
                static_cast<float>(q[2]) * scale, (static_cast<float>(q[3]) - part) * scale}};
    float* nudged[] = {&two.b.x, &two.b.y, &two.b.z, &two.b.r, &two.a.r};
    float& value = *nudged[random_() % 5];
    const float toward[] = {-INFINITY, value, INFINITY};
    value = std::max(std::nextafter(value, toward[random_() % 3]), 0.0F);
    return two;
  }

  Two denormal() {
    const auto tiny = [&] { return std::ldexp(static_cast<float>(random_() % 64), -149); };
    return {{tiny(), -tiny(), tiny(), tiny()}, {tiny(), tiny(), -tiny(), tiny()}};
  }

 private:
  std::mt19937 random_;
};

bool fast_filter_applies(const Two& two) {
  return in_fast_range(two.a.r) && in_fast_range(two.b.r);
}

struct Tally {
  int decided = 0;
  int by_filter = 0;
  int by_float64 = 0;
};

void expect_right(const Two& two, Tally& tally) {
  const bool truth = reference::overlap(two.a, two.b);
  const Verdict right = truth ? Verdict::overlap : Verdict::apart;
  const auto certain_and_right = [&](Verdict v) { return v == Verdict::uncertain || v == right; };
  const Verdict safe = filter_verdict<Filter::safe>(two.a, two.b);
  ASSERT_TRUE(certain_and_right(safe));
  if (fast_filter_applies(two)) {
    ASSERT_TRUE(certain_and_right(filter_verdict<Filter::fast>(two.a, two.b)));
  }
  const Verdict float64 = exact::float64_test(two.a, two.b);
  ASSERT_TRUE(certain_and_right(float64));
  ASSERT_EQ(exact::integer_test(two.a, two.b), truth);
  ASSERT_EQ(overlap_exact(two.a, two.b), truth);
  ASSERT_EQ(overlap_exact(two.b, two.a), truth);
  ++tally.decided;
  tally.by_filter += safe != Verdict::uncertain ? 1 : 0;
  tally.by_float64 += float64 != Verdict::uncertain ? 1 : 0;
}

constexpr int kPairs = 100000;

TEST(Predicate, IsRightOnRandomBits) {
  Maker make(1);
  Tally tally;
  for (int k = 0; k < kPairs && !HasFatalFailure(); ++k) expect_right(make.random_bits(), tally);
}

TEST(Predicate, IsRightNearTangencyAtEveryScale) {
  Maker make(2);
  Tally tally;
  for (int k = 0; k < kPairs && !HasFatalFailure(); ++k) {
    expect_right(make.near_tangent(-140, 126, 0.0), tally);
    expect_right(make.near_tangent(-4, 4, 0.0), tally);
    expect_right(make.near_tangent(-4, 4, 1e5), tally);
  }
  EXPECT_GT(tally.by_float64, tally.by_filter) << "no uncertain pair ever reached level 2";
}

TEST(Predicate, IsRightOnTiesAndTheirNeighbours) {
  Maker make(3);
  Tally tally;
  for (int k = 0; k < kPairs && !HasFatalFailure(); ++k) expect_right(make.pythagorean(), tally);
  EXPECT_LT(tally.by_filter, tally.decided);
}

TEST(Predicate, IsRightOnDenormals) {
  Maker make(4);
  Tally tally;
  for (int k = 0; k < kPairs && !HasFatalFailure(); ++k) expect_right(make.denormal(), tally);
}

TEST(Predicate, LevelThreeIsReached) {
  // 2^-80 does not fit beside 1 in 53 bits: float64 cannot see it, integers can.
  const Two touching = {{0, 0, 0, 1.0F}, {0, 0, 1.0F + 0x1p-20F, 0x1p-20F}};
  const Two tiny_gap = {{-0x1p-80F, 0, 0, 1.0F}, {2.0F, 0, 0, 1.0F}};
  EXPECT_NE(exact::float64_test(touching.a, touching.b), Verdict::uncertain);
  EXPECT_EQ(exact::float64_test(tiny_gap.a, tiny_gap.b), Verdict::uncertain);
  EXPECT_FALSE(overlap_exact(tiny_gap.a, tiny_gap.b));
  const Two tiny_overlap = {{0x1p-80F, 0, 0, 1.0F}, {2.0F, 0, 0, 1.0F}};
  EXPECT_TRUE(overlap_exact(tiny_overlap.a, tiny_overlap.b));
}

TEST(Predicate, TangentSpheresOverlapAndPointsMeetOnlyThemselves) {
  EXPECT_TRUE(overlap_exact({0, 0, 0, 0.5F}, {1, 0, 0, 0.5F}));
  EXPECT_FALSE(overlap_exact({0, 0, 0, 0.5F}, {std::nextafter(1.0F, 2.0F), 0, 0, 0.5F}));
  EXPECT_TRUE(overlap_exact({-0.0F, 0, 0, 0}, {0.0F, 0, 0, 0}));
  EXPECT_FALSE(overlap_exact({0, 0, 0, 0}, {0x1p-149F, 0, 0, 0}));
}

TEST(Predicate, NothingOverflows) {
  const float huge = 0x1.fffffep127F;
  EXPECT_FALSE(overlap_exact({-huge, 0, 0, huge / 2}, {huge, 0, 0, huge / 2}));
  EXPECT_TRUE(overlap_exact({-huge, 0, 0, huge}, {huge, 0, 0, huge}));
  EXPECT_TRUE(overlap_exact({-huge, 0, 0, huge}, {0, 0, 0, 1}));
}

}  // namespace
}  // namespace octocell
