// SPDX-License-Identifier: MIT
// Rows several diameters wide: which of their spheres may have partners beyond a border?
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "core/planner/planner.hpp"
#include "impl_cpu/half_shell/borders.hpp"

namespace octocell::cpu {
namespace {

/// Of two spheres that are within distance of each other, in cells to both sides of a border, both
/// lie where that border's partners are looked for; and not many others do.
TEST(HalfShellBorders, LeaveOutNoPartnerAndFewOthers) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
  };
  for (int trial = 0; trial < 20000; ++trial) {
    const float r = std::ldexp(between(0.5, 1.0), static_cast<int>(random() % 200) - 100);
    const double side = 2.0 * static_cast<double>(r) * static_cast<double>(between(1.0, 16.0));
    const double centre = trial % 2 == 0 ? 0.0 : side * static_cast<double>(between(-1e4, 1e4));
    PlanFacts facts;
    for (int a = 0; a < 3; ++a) {
      facts.lowest[a] = static_cast<float>(centre - 20.0 * side);
      facts.highest[a] = static_cast<float>(centre + 20.0 * side);
    }
    const Grid grid = make_level(facts, r, side, 1, 28).grid;
    const auto above = static_cast<std::uint32_t>(1 + random() % (grid.cell_count[1] - 1));
    const float distance = 2.0F * r;
    const half_shell::Border border = half_shell::border_below(grid, 1, above, distance);
    const double apart = static_cast<double>(border.upper) - static_cast<double>(border.lower);
    const double ulps = 0x1p-20 * std::fabs(static_cast<double>(border.upper));
    ASSERT_LE(apart, 2.001 * static_cast<double>(distance) + ulps) << trial;
    // Around the border, in steps that a float can take.
    float p = border.lower;
    for (int step = 0; step < 40; ++step) p = std::nextafter(p, HUGE_VALF);
    for (int step = 0; step < 80; ++step, p = std::nextafter(p, -HUGE_VALF)) {
      const float q = p + distance;
      const bool partners = static_cast<double>(q) - static_cast<double>(p) <= 2.0 * r &&
                            cell_coordinate(grid, 1, p) < above &&
                            cell_coordinate(grid, 1, q) >= above;
      if (!partners) continue;
      ASSERT_GT(p, border.lower) << trial;
      ASSERT_LT(q, border.upper) << trial;
    }
  }
}

TEST(HalfShellBorders, AreTheSameWhereTheAxisWraps) {
  PlanFacts facts;
  for (int a = 0; a < 3; ++a) facts.highest[a] = 1e3F;
  const Grid open = make_level(facts, 0.5F, 4.0, 1, 28).grid;
  const Grid wrapped = make_level(facts, 0.5F, 4.0, 1, 12).grid;
  ASSERT_FALSE(open.wraps(1));
  ASSERT_TRUE(wrapped.wraps(1));
  for (std::uint32_t above = 0; above < open.cell_count[1]; ++above) {
    const half_shell::Border border = half_shell::border_below(wrapped, 1, above, 1.0F);
    EXPECT_EQ(border.lower, half_shell::border_below(open, 1, above, 1.0F).lower);
    EXPECT_EQ(border.upper, half_shell::border_below(open, 1, above, 1.0F).upper);
    EXPECT_EQ(border.lower == -HUGE_VALF, above == 0);
  }
}

TEST(HalfShellBorders, AreThoseOfACellThatAllSpheresShare) {
  PlanFacts facts;
  for (int a = 0; a < 3; ++a) facts.highest[a] = 1e3F;
  const Grid grid = make_level(facts, 0.5F, 4.0, 1, 12).grid;
  ASSERT_TRUE(grid.wraps(1));
  for (const std::size_t count : {1, 15, 16, 17, 100}) {
    std::vector<float> values(count, 401.0F);
    const std::uint32_t cell = cell_coordinate(grid, 1, values[0]);
    const float far = 401.0F + 4.0F * static_cast<float>(grid.period(1));  // with the same id
    ASSERT_EQ((cell_coordinate(grid, 1, far) - cell) & grid.wrap_mask[1], 0U);
    EXPECT_EQ(half_shell::common_cell(grid, 1, values), cell);
    for (std::size_t k = 0; k < count; ++k) {
      for (const float other : {far, 0.0F}) {
        values[k] = other;
        const auto found = half_shell::common_cell(grid, 1, values);
        EXPECT_EQ(found.has_value(), count == 1) << count << " " << k;
        values[k] = 401.0F;
      }
    }
  }
}

TEST(HalfShellBorders, OfInfiniteReachesLeaveOutNothing) {
  const auto all = [](const half_shell::Border& b) {
    return b.lower == -HUGE_VALF && b.upper == HUGE_VALF;
  };
  PlanFacts facts;
  for (int a = 0; a < 3; ++a) facts.highest[a] = 1e3F;
  const Grid open = make_level(facts, 0.5F, 4.0, 1, 28).grid;
  EXPECT_FALSE(all(half_shell::border_below(open, 1, 9, 1.0F)));
  EXPECT_TRUE(all(half_shell::border_below(open, 1, 9, HUGE_VALF)));
}

}  // namespace
}  // namespace octocell::cpu
