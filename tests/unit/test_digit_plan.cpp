// SPDX-License-Identifier: MIT
// How keys are cut into digits; needs no GPU.
#include <gtest/gtest.h>

#include "core/digit_plan.hpp"

namespace octocell {
namespace {

TEST(DigitPlan, CoversEveryBitOnceFromTheLowest) {
  for (const int widest : {1, 8, 9, 10}) {
    for (int bits = 0; bits <= 32; ++bits) {
      const DigitPlan plan = digit_plan(bits, widest);
      int covered = 0;
      for (int pass = 0; pass < plan.passes; ++pass) {
        EXPECT_EQ(plan.digits[pass].shift, covered);
        covered += plan.digits[pass].width;
      }
      EXPECT_EQ(covered, bits) << widest;
    }
  }
}

TEST(DigitPlan, HasAsFewPassesAsTheWidestDigitAllows) {
  for (const int widest : {1, 8, 9, 10}) {
    for (int bits = 0; bits <= 32; ++bits) {
      const int passes = digit_plan(bits, widest).passes;
      EXPECT_GE(passes * widest, bits);
      EXPECT_LT((passes - 1) * widest, bits == 0 ? 1 : bits);
    }
  }
}

TEST(DigitPlan, DigitsAreEvenAndTheWidestComesFirst) {
  for (int bits = 1; bits <= 32; ++bits) {
    const DigitPlan plan = digit_plan(bits, 10);
    for (int pass = 0; pass < plan.passes; ++pass) {
      EXPECT_LE(plan.digits[pass].width, plan.width());
      EXPECT_GE(plan.digits[pass].width, plan.width() - 1);
      EXPECT_GE(plan.digits[pass].width, 1);
    }
  }
}

TEST(DigitPlan, OfTheWidthsThatCellIdsHave) {
  EXPECT_EQ(digit_plan(0, 10).passes, 0);
  EXPECT_EQ(digit_plan(0, 10).width(), 0);
  EXPECT_EQ(digit_plan(12, 10).width(), 6);
  EXPECT_EQ(digit_plan(17, 10).passes, 2);
  EXPECT_EQ(digit_plan(17, 10).digits[0].width, 9);
  EXPECT_EQ(digit_plan(17, 10).digits[1].width, 8);
  EXPECT_EQ(digit_plan(20, 10).passes, 2);
  EXPECT_EQ(digit_plan(20, 10).width(), 10);
  EXPECT_EQ(digit_plan(24, 10).passes, 3);
  EXPECT_EQ(digit_plan(32, 10).passes, 4);
  EXPECT_EQ(digit_plan(32, 10).width(), 8);
}

}  // namespace
}  // namespace octocell
