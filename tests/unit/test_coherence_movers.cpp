// SPDX-License-Identifier: MIT
// Frames in which few spheres have moved: their pairs are found again, the others' are kept.
#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <string>

#include "harness/scenes/scenes.hpp"
#include "impl_cpu/backend.hpp"
#include "tests/support/frame_player.hpp"

namespace octocell {
namespace {

Player on_cpu(const PlanOptions& options) { return {options, cpu::make_backend()}; }

TEST(FewMovers, CostWorkInProportionToThem) {
  for (const char* spec : {"gas:n=20000", "dense:n=20000", "poly:n=20000", "giant:n=20000"}) {
    const Frames frames = played(spec, Motion::few, 6);
    Player player = on_cpu(moving(Skips::all().without(Skip::skin)));
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const Counts counts = player.check({frames[f]}, spec);
      if (f == 0) continue;
      EXPECT_EQ(counts.reused, Skip::few_movers) << spec;
      EXPECT_NEAR(static_cast<double>(counts.ids), 2000.0, 200.0) << spec;
      EXPECT_LE(counts.candidates, 400 * (counts.ids + counts.pairs)) << spec;
    }
    EXPECT_EQ(player.plans(), 1) << spec;
  }
}

/// They move too far for a skin, and are too few for a search of all.
TEST(FewMovers, ServeWhereAFewFlyFar) {
  const Frames frames = played("gas:n=20000", Motion::darts, 12);
  Player player = on_cpu(moving());
  std::size_t served = 0;
  for (const Spheres& frame : frames) {
    served += player.check({frame}, "darts").reused == Skip::few_movers ? 1 : 0;
  }
  EXPECT_GE(served, frames.size() - 2);
}

TEST(FewMovers, OneAloneIsLookedForAlone) {
  Spheres spheres = generate("gas:n=20000").spheres;
  Player player = on_cpu(moving());
  player.check({spheres}, "start");
  for (int step = 0; step < 5; ++step) {
    spheres[77].x *= 0.9F;
    const Counts counts = player.check({spheres}, "a step");
    EXPECT_EQ(counts.reused, Skip::few_movers);
    EXPECT_EQ(counts.ids, 1U);
    EXPECT_LE(counts.candidates, 600U);
  }
}

TEST(FewMovers, AreGivenUpWhenTheyAreMany) {
  Player player = on_cpu(moving(Skips::all().without(Skip::skin)));
  Spheres spheres = generate("gas:n=6000").spheres;
  int searches = 0;
  for (std::size_t f = 0; f < 30; ++f) {  // another twentieth each time
    for (std::size_t i = f % 20; i < spheres.size(); i += 20) spheres[i].y *= 0.99F;
    searches += player.check({spheres}, "twentieth").reused ? 0 : 1;
  }
  EXPECT_GE(searches, 6);
  EXPECT_LE(searches, 9);
}

/// The movers pass through stages 2 to 4 by themselves, block by block. What the blocks of many
/// have left behind is none of the business of a few that come after them.
TEST(FewMovers, MayBeFewerThanTheyWereBefore) {
  Player player = on_cpu(moving(Skips::all().without(Skip::skin)));
  Spheres spheres = generate("gas:n=120000").spheres;
  const auto step = [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) spheres[i].x += 0.25F;
    return player.check({spheres}, std::to_string(count) + " movers");
  };
  player.check({spheres}, "start");
  EXPECT_EQ(step(0, 19000).reused, Skip::few_movers);  // two blocks
  EXPECT_EQ(step(19000, 19000).reused, std::nullopt);  // too many: none has moved since
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(step(2000 * k, 2000).reused, Skip::few_movers);
}

}  // namespace
}  // namespace octocell
