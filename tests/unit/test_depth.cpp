// SPDX-License-Identifier: MIT
// Depths: values known by hand, and the proved bound against exact arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/depth.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell {
namespace {

constexpr double kProvedUlp = 0.5 + 2.5e-6;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr Sphere at(float x, float r) { return {x, 0, 0, r}; }

struct Known {
  Sphere a;
  Sphere b;
  float depth;
};

const Known kKnown[] = {
    {at(0, 1), at(0, 3), 4.0F},
    {at(0, 1), at(1, 1), 1.0F},
    {at(0, 1), at(3, 1), -1.0F},
    {{0, 0, 0, 1}, {3, 4, 12, 13}, 1.0F},
    // 2^-149 deep at a reach of 2^127, and less than any float32 apart there.
    {at(0, 0x1p127F), at(0x1p127F, 0x1p-149F), 0x1p-149F},
    {at(0, 0x1p127F), {0x1p127F, 0x1p-149F, 0, 0}, -0.0F},
    // The one square root: 2 - sqrt 3 and its nearest float32.
    {{0, 0, 0, 1}, {1, 1, 1, 1}, 0x1.126146p-2F},
    // Near contact: 2^-30 and 1 - sqrt(1 - 2^-24) = 2^-25 + 2^-51 + ...
    {at(0, 1), at(1, 0x1p-30F), 0x1p-30F},
    {at(0, 0.5F), {0x1p-12F, 1, 0, 0.5F}, -0x1.000000p-25F},
    {at(0, kFloatMax), at(0, kFloatMax), kInfinity},
    {at(-kFloatMax, 0), at(kFloatMax, 0), -kInfinity},
    {at(0, 0), at(1, 0), -1.0F},
};

TEST(Depth, IsWhatIsKnownByHand) {
  for (const Known& known : kKnown) {
    EXPECT_EQ(penetration_depth(known.a, known.b), known.depth) << known.depth;
    EXPECT_EQ(penetration_depth(known.b, known.a), known.depth) << known.depth;
    EXPECT_EQ(reference::depth(known.a, known.b), known.depth) << known.depth;
    EXPECT_LE(reference::depth_error_ulp(known.depth, known.a, known.b), 0.5) << known.depth;
  }
}

TEST(Depth, OfSpheresThatTouchIsZero) {
  const Sphere one = {0, 0, 0, 1};
  for (const Sphere& other : {Sphere{2, 3, 6, 6}, Sphere{-9, 2, -6, 10}, Sphere{0, 0, -2, 1}}) {
    for (const int exponent : {-140, -60, 0, 60, 120}) {
      const auto scaled = [&](const Sphere& s) {
        return Sphere{std::ldexp(s.x, exponent), std::ldexp(s.y, exponent),
                      std::ldexp(s.z, exponent), std::ldexp(s.r, exponent)};
      };
      EXPECT_EQ(penetration_depth(scaled(one), scaled(other)), 0.0F) << exponent;
      EXPECT_FALSE(std::signbit(penetration_depth(scaled(one), scaled(other))));
    }
  }
  EXPECT_EQ(penetration_depth(at(7, 0), at(7, 0)), 0.0F);
}

TEST(Depth, ErrorsAreMeasuredFromTheRealDepth) {
  const Sphere a = {0, 0, 0, 1};
  const Sphere b = {1, 1, 1, 1};
  const float nearest = reference::depth(a, b);
  const double half = reference::depth_error_ulp(nearest, a, b);
  EXPECT_GT(half, 0.0);
  EXPECT_LE(half, 0.5);
  const float up = std::nextafter(nearest, 1.0F);
  const float down = std::nextafter(nearest, 0.0F);
  EXPECT_NEAR(reference::depth_error_ulp(up, a, b) + reference::depth_error_ulp(down, a, b), 2.0,
              1e-12);
  EXPECT_EQ(reference::depth_error_ulp(kInfinity, a, b), std::numeric_limits<double>::infinity());
  EXPECT_EQ(reference::depth_error_ulp(1.0F, at(0, 1), at(1, 1)), 0.0);
  EXPECT_EQ(reference::depth_error_ulp(0x1p-149F, at(0, 1), at(2, 1)), 1.0);
}

TEST(Depth, ErrorsOfManyAreSummedUp) {
  const std::vector<Sphere> row = {at(0, 1), at(1, 1), at(2, 1), at(3, 1)};
  const std::vector<Pair> pairs = {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}};
  std::vector<float> depths = penetration_depths(row, pairs);
  EXPECT_EQ(depths, (std::vector<float>{1, 0, 1, 0, 1}));
  EXPECT_EQ(reference::depth_errors(depths, pairs, row).max_ulp, 0.0);
  depths[2] += 3 * 0x1p-23F;
  const reference::DepthErrors errors = reference::depth_errors(depths, pairs, row);
  EXPECT_EQ(errors.median_ulp, 0.0);
  EXPECT_EQ(errors.p99_ulp, 3.0);
  EXPECT_EQ(errors.max_ulp, 3.0);
  EXPECT_EQ(errors.not_nearest, 1U);
  EXPECT_EQ(reference::depth_errors({}, {}, row).max_ulp, 0.0);
}

TEST(Depth, KeepsItsBoundOnEveryScene) {
  for (const char* spec : {"gas:n=3000,phi=0.3", "poly:n=3000,ratio=1e6", "lattice:n=3000",
                           "lattice:n=3000,spacing=0.1", "fcc:n=3000", "shifted:n=3000,offset=1e4",
                           "giant:n=2000", "discs:n=3000"}) {
    const Scene scene = generate(spec);
    const std::vector<Pair> pairs = reference::exact_pairs(scene);
    const std::vector<float> depths = penetration_depths(scene.spheres, pairs);
    ASSERT_FALSE(pairs.empty()) << spec;
    EXPECT_LE(reference::depth_errors(depths, pairs, scene.spheres).max_ulp, kProvedUlp) << spec;
    for (const float depth : depths) ASSERT_GE(depth, 0.0F) << spec;
  }
}

/// Just inside and just outside of contact, where the plain formulas lose their digits.
TEST(Depth, KeepsItsBoundNearContact) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double worst = 0.0;
  double worst_plain = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const double v[] = {uniform(random), uniform(random), uniform(random)};
    const Sphere a = {0, 0, 0, static_cast<float>(std::fabs(uniform(random)))};
    const auto r = static_cast<float>(std::fabs(uniform(random)));
    const double off = 1.0 + std::ldexp(uniform(random), -(k % 26));
    const double step = (static_cast<double>(a.r) + r) * off / std::hypot(v[0], v[1], v[2]);
    const Sphere b = {static_cast<float>(v[0] * step), static_cast<float>(v[1] * step),
                      static_cast<float>(v[2] * step), r};
    worst = std::max(worst, reference::depth_error_ulp(penetration_depth(a, b), a, b));
    const float plain = a.r + b.r - std::sqrt(filter_distance2(a, b));
    worst_plain = std::max(worst_plain, reference::depth_error_ulp(plain, a, b));
  }
  EXPECT_LE(worst, kProvedUlp);
  EXPECT_GT(worst_plain, 1000.0);
}

}  // namespace
}  // namespace octocell
