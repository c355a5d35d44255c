// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "core/planner/planner.hpp"

namespace octocell {
namespace {

PlanFacts facts_of_box(float low, float high, float r_max) {
  PlanFacts facts;
  facts.sphere_count = 2;
  for (int a = 0; a < 3; ++a) {
    facts.lowest[a] = low;
    facts.highest[a] = high;
  }
  facts.r_max = facts.r_min_nonzero = r_max;
  return facts;
}

struct Setting {
  float low;
  float high;
  double side;
};

const Setting kSettings[] = {
    {0.0F, 100.0F, 1.0},     {-50.0F, 50.0F, 3.7},     {1e6F, 1.0001e6F, 1.0},
    {1e7F, 1.00001e7F, 1.3}, {-1e-40F, 1e-40F, 1e-42}, {-3e38F, 3e38F, 1e36},
    {-1.0F, 1.0F, 1e-7},     {0.0F, 0.0F, 1.0},        {-1e10F, 1e10F, 1.0},
    {0.1F, 12.8F, 0.1},      {-8.0F, 8.0F, 0.25},      {1e30F, 2e30F, 3e24},
};

/// |a - b| > side over the reals: the difference in float64, and what it rounded away.
bool further_apart_than(double side, float a, float b) {
  const double high = std::max(a, b);
  const double low = std::min(a, b);
  const double difference = high - low;
  const double low_part = high - difference;
  const double rest = (high - (difference + low_part)) + (low_part - low);
  return difference > side || (difference == side && rest > 0.0);
}

class Grids : public testing::TestWithParam<Setting> {
 protected:
  Grid grid() const {
    const auto [low, high, side] = GetParam();
    return make_grid(facts_of_box(low, high, static_cast<float>(side / 2)), side, side);
  }
  /// Mostly in the box, sometimes a few ulps off a cell border, sometimes far outside.
  float coordinate(std::mt19937& random, const Grid& g) const {
    const auto [low, high, side] = GetParam();
    std::uniform_real_distribution<double> inside(low, high);
    double value = inside(random);
    if (random() % 2 == 0) value = std::round(value / g.cell_side) * g.cell_side;
    auto rounded = static_cast<float>(std::clamp<double>(value, -kFloatMax, kFloatMax));
    for (unsigned step = random() % 4; step > 0; --step) {
      rounded = std::nextafter(rounded, random() % 2 == 0 ? -kFloatMax : kFloatMax);
    }
    return rounded;
  }
};

TEST_P(Grids, AreMonotone) {
  const Grid g = grid();
  std::mt19937 random(1);
  for (int k = 0; k < 200000; ++k) {
    const float a = coordinate(random, g);
    const float b = coordinate(random, g);
    ASSERT_LE(cell_coordinate(g, 0, std::min(a, b)), cell_coordinate(g, 0, std::max(a, b)));
  }
}

TEST_P(Grids, PutValuesAtMostASideApartIntoTheSameOrAdjacentCells) {
  const Grid g = grid();
  std::mt19937 random(2);
  int tried = 0;
  for (int k = 0; k < 400000; ++k) {
    const float a = coordinate(random, g);
    const double shift = std::uniform_real_distribution<double>(-1.0, 1.0)(random) * g.cell_side;
    auto b = static_cast<float>(std::clamp<double>(a + shift, -kFloatMax, kFloatMax));
    if (k % 3 == 0) b = static_cast<float>(std::min<double>(a + g.cell_side, kFloatMax));
    if (further_apart_than(g.cell_side, a, b)) continue;
    ++tried;
    const std::uint32_t ca = cell_coordinate(g, 0, a);
    const std::uint32_t cb = cell_coordinate(g, 0, b);
    ASSERT_LE(ca > cb ? ca - cb : cb - ca, 1U) << a << " and " << b;
  }
  EXPECT_GT(tried, 100000);
}

TEST_P(Grids, HaveSidesOfAtLeastWhatWasAskedAndIdsThatFit) {
  const Grid g = grid();
  EXPECT_GE(g.cell_side, GetParam().side);
  EXPECT_LE(g.key_bits, 31);
  std::mt19937 random(3);
  for (int k = 0; k < 100000; ++k) {
    const Cell cell =
        cell_of(g, coordinate(random, g), coordinate(random, g), coordinate(random, g));
    ASSERT_LT(std::uint64_t{cell_id(g, cell)}, std::uint64_t{1} << g.key_bits);
    ASSERT_LT(cell.x, g.cell_count[0]);
  }
}

TEST_P(Grids, DivideUnitsByTheReciprocalExactly) {
  const Grid g = grid();
  std::mt19937 random(4);
  for (int k = 0; k < 100000; ++k) {
    const std::uint64_t unit = k < 1000 ? static_cast<unsigned>(k) : random() >> 2;  // below 2^30
    ASSERT_EQ(unit * g.width[0].reciprocal >> g.width[0].reciprocal_bits, unit / g.width[0].units)
        << unit;
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, Grids, testing::ValuesIn(kSettings));

TEST(Grid, ClampsWhatLiesOutsideItsBoxAndInfinity) {
  const Grid g = make_grid(facts_of_box(0.0F, 10.0F, 0.5F), 1.0, 1.0);
  EXPECT_EQ(cell_coordinate(g, 0, -INFINITY), 0U);
  EXPECT_EQ(cell_coordinate(g, 0, -1e30F), 0U);
  EXPECT_EQ(cell_coordinate(g, 0, INFINITY), g.cell_count[0] - 1);
  EXPECT_EQ(cell_coordinate(g, 0, 1e30F), g.cell_count[0] - 1);
}

TEST(Grid, FloorsNegativeCoordinates) {
  const Grid g = make_grid(facts_of_box(-2.0F, 2.0F, 0.5F), 1.0, 1.0);
  EXPECT_EQ(cell_coordinate(g, 0, -0.3F) + 1, cell_coordinate(g, 0, 0.3F));
}

TEST(Grid, WrapsWithPeriodsWiderThanTwoBoxes) {
  PlanFacts facts = facts_of_box(-1e10F, 1e10F, 1.0F);
  for (const double side : {2.0, 100.0, 1e5}) {
    const double widest = widest_box(facts, 1.0F);
    const Grid g = make_grid(facts, side, widest);
    ASSERT_LE(g.key_bits, 31);
    for (const std::uint32_t mask : g.wrap_mask) {
      if (mask == ~0U) continue;
      EXPECT_EQ(mask & (mask + 1), 0U) << "a period is a power of two";
      EXPECT_GE(mask + 1.0, 2.0 * (widest / g.cell_side + 2.0));
    }
  }
}

}  // namespace
}  // namespace octocell
