// SPDX-License-Identifier: MIT
// How much of the predicate's margins rounding can use up. With random numbers, roundings rarely
// all go in one direction, so wrong margins would not be noticed. So here each pair climbs: a step
// is kept if it brings a wrong verdict nearer.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

// needs the above
#include <rapidcheck/gtest.h>

#include "core/overlap.hpp"
#include "tests/properties/generators.hpp"

namespace octocell {
namespace {

using properties::Two;

/// Returns D / R to 2^-60; the climb looks for roundings of 2^-24 and 2^-53.
long double true_ratio(const Two& two) {
  const auto square = [](float p, float q) {
    const long double d = static_cast<long double>(p) - q;
    return d * d;
  };
  const long double radius_sum = static_cast<long double>(two.a.r) + two.b.r;
  return (square(two.a.x, two.b.x) + square(two.a.y, two.b.y) + square(two.a.z, two.b.z)) /
         (radius_sum * radius_sum);
}

template <Filter filter>
float grown_radius_sum2(const Two& two) {
  const float radius_sum = filter_radius<filter>(two.a.r) + filter_radius<filter>(two.b.r);
  return radius_sum * radius_sum;
}

/// If above 1, a pair that overlaps could be called apart: D^ / H must not exceed D / R.
template <Filter filter>
long double danger_of_a_loss(const Two& two) {
  return filter_distance2(two.a, two.b) / (grown_radius_sum2<filter>(two) * true_ratio(two));
}

/// If above 1, a pair that is apart could be called an overlap: D^ / fl(L H) must not be below D /
/// R.
template <Filter filter>
long double danger_of_a_false_pair(const Two& two) {
  return filter_sure_below<filter>(grown_radius_sum2<filter>(two)) * true_ratio(two) /
         filter_distance2(two.a, two.b);
}

/// If above 1, float64 could be certain and wrong: returns its error in units of its own bound.
long double danger_of_float64(const Two& two) {
  const auto& [a, b] = two;
  const exact::Float64Test<double> test(a.x, a.y, a.z, a.r, b.x, b.y, b.z, b.r);
  const long double ratio = static_cast<long double>(test.distance2) / test.radius_sum2;
  return std::abs(ratio / true_ratio(two) - 1.0L) / (test.bound / test.radius_sum2);
}

using Danger = long double (*)(const Two&);

/// Knuth's MMIX generator, so that a climb can be repeated from its seed.
class Steps {
 public:
  explicit Steps(std::uint64_t seed) : state_(seed) {}
  int below(int bound) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<int>((state_ >> 33) % static_cast<unsigned>(bound));
  }

 private:
  std::uint64_t state_;
};

/// Makes one or two of the eight numbers a little larger or smaller: by 2^-1 to 2^-24 of
/// themselves.
Two stepped(Two two, Steps& steps) {
  float* const numbers[] = {&two.a.x, &two.a.y, &two.a.z, &two.a.r,
                            &two.b.x, &two.b.y, &two.b.z, &two.b.r};
  for (int changes = 1 + steps.below(2); changes > 0; --changes) {
    float& number = *numbers[steps.below(8)];
    number += std::ldexp(number * static_cast<float>(steps.below(15) - 7), -3 - steps.below(24));
  }
  return two;
}

Two climb(Two best, Danger danger, Steps steps) {
  constexpr int kStepsOfAClimb = 3000;
  for (int step = 0; step < kStepsOfAClimb; ++step) {
    const Two next = stepped(best, steps);
    if (danger(next) >= danger(best)) best = next;
  }
  return best;
}

/// Returns the worst of some hundred climbs, from pairs of numbers within a factor of two (or
/// `scales`).
Two worst(Danger danger, std::uint32_t scales = 1) {
  constexpr int kClimbs = 300;
  const auto number = properties::float_between(127 - scales, 127);
  const auto radius = rc::gen::map(number, [](float r) { return std::fabs(r); });
  const auto sphere = rc::gen::construct<Sphere>(number, number, number, radius);
  Two worst = {{0, 0, 0, 1}, {2, 0, 0, 1}};
  for (std::uint64_t seed = 0; seed < kClimbs; ++seed) {
    const auto pair = rc::gen::construct<Two>(sphere, sphere);
    const Two top = climb(pair(rc::Random(seed)).value(), danger, Steps(seed));
    if (danger(top) > danger(worst)) worst = top;
  }
  return worst;
}

constexpr long double kU = 0x1p-24L;

TEST(Margins, KeepEveryPairInTheFastFilter) {
  const long double danger = danger_of_a_loss<Filter::fast>(worst(danger_of_a_loss<Filter::fast>));
  EXPECT_LT(danger, 1.0L - 1.9L * kU) << "proved: a margin of almost 2u";
  EXPECT_GT(danger, 1.0L - 4.0L * kU) << "the climbs no longer come near the worst case";
}

TEST(Margins, KeepEveryPairInTheSafeFilter) {
  const long double danger = danger_of_a_loss<Filter::safe>(worst(danger_of_a_loss<Filter::safe>));
  EXPECT_LT(danger, 1.0L - 1.9L * kU);
  EXPECT_GT(danger, 1.0L - 4.0L * kU);
}

TEST(Margins, MakeUpNoPairInTheFastFilter) {
  const Danger danger = danger_of_a_false_pair<Filter::fast>;
  const long double worst_danger = danger(worst(danger));
  EXPECT_LT(worst_danger, 1.0L - 0.9L * kU) << "proved: a margin of u";
  EXPECT_GT(worst_danger, 1.0L - 4.0L * kU);
}

TEST(Margins, MakeUpNoPairInTheSafeFilter) {
  const Danger danger = danger_of_a_false_pair<Filter::safe>;
  const long double worst_danger = danger(worst(danger));
  EXPECT_LT(worst_danger, 1.0L - 0.9L * kU);
  EXPECT_GT(worst_danger, 1.0L - 4.0L * kU);
}

TEST(Margins, OfFloat64AreWideEnough) {
  const long double danger = danger_of_float64(worst(danger_of_float64, 60));
  EXPECT_LT(danger, 0.81L) << "proved: 8 U and a little, of 10 U";
  EXPECT_GT(danger, 0.3L);
}

}  // namespace
}  // namespace octocell
