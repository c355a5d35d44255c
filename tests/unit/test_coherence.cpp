// SPDX-License-Identifier: MIT
// Frames that reuse data of the last one: every frame of every sequence has the exact pair set, and
// does no more work than the skip promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/planner/skin_width.hpp"
#include "harness/scenes/scenes.hpp"
#include "impl_cpu/backend.hpp"
#include "tests/support/frame_player.hpp"

namespace octocell {
namespace {

Player on_cpu(const PlanOptions& options) { return {options, cpu::make_backend()}; }

/// How many threads; the share of static spheres, whether or not they stand: below zero, no flags.
class Sequences : public testing::TestWithParam<std::pair<int, double>> {};

TEST_P(Sequences, HaveTheExactPairsWhateverIsAllowed) {
  const int threads = GetParam().first;
  const double static_share = GetParam().second;
  Served served = {};
  play_with_every_choice([&](Skips allowed) { return on_cpu(moving(allowed, threads)); },
                         [&](const Spheres& s) { return flags_of(s.size(), static_share, 11); },
                         served);
  // A static sphere that does move, as here, ends a list.
  expect_all_to_have_served({Skip::unchanged, Skip::few_movers, Skip::skin}, served,
                            static_share < 0.0 ? 50 : 40);
}

INSTANTIATE_TEST_SUITE_P(ThreadsAndStatics, Sequences,
                         testing::Values(std::pair(1, -1.0), std::pair(3, -1.0), std::pair(1, 0.3),
                                         std::pair(3, 0.9)));

/// Static ones stand, as they should.
TEST(EveryFrame, AmongStaticSpheresIsExact) {
  for (const char* spec : {"gas:n=8000", "dense:n=3000", "poly:n=3000"}) {
    const Spheres start = generate(spec).spheres;
    const AllFlags flags = flags_of(start.size(), 0.9, 12);
    for (const Motion motion : {Motion::brownian, Motion::slow, Motion::few, Motion::gravity}) {
      Player player = on_cpu(moving());
      int served = 0;
      for (const Spheres& spheres : move(start, motion, 20, 1, flags)) {
        served += player.check({spheres, flags}, spec).reused ? 1 : 0;
      }
      EXPECT_TRUE(served >= 10 || motion == Motion::gravity) << spec << ": " << served;
    }
  }
}

/// Without a new plan, as no driver of ours would do.
TEST(EveryFrame, OfAnotherNumberIsForgotten) {
  const Spheres start = generate("gas:n=2000").spheres;
  const Spheres none;
  const std::unique_ptr<PairFinder> finder = cpu::make_backend();
  finder->upload(plan_scene({start}, moving()), {start});
  HostClock clock;
  for (const Spheres* spheres : {&start, &none, &start, &start}) {
    finder->update({*spheres});
    finder->find_pairs(clock);
    EXPECT_EQ(finder->digest(), digest_of(reference::exact_pairs(*spheres)));
  }
}

/// Nothing moves; who may collide with whom changes, in place.
TEST(EveryFrame, GoesByTheFlagsOfNow) {
  const Spheres spheres = generate("dense:n=1500").spheres;
  std::vector<Flags> flags(spheres.size());
  const SceneView scene = {spheres, flags};
  const std::unique_ptr<PairFinder> finder = cpu::make_backend();
  finder->upload(plan_scene(scene, moving()), scene);
  HostClock clock;
  for (const std::uint32_t group : {1, 1, 2, 2, 1}) {
    for (std::size_t i = 0; i < flags.size(); i += 2) flags[i] = make_flags(false, group, group);
    finder->update(scene);
    finder->find_pairs(clock);
    EXPECT_EQ(finder->digest(), digest_of(reference::exact_pairs(spheres, flags))) << group;
  }
}

// ---------------------------------------------------------------------------- and at what expense

bool ran(const StageTimes& times, Stage stage) {
  return times.stage_ms[index_of(stage)].has_value();
}

TEST(Unchanged, FramesNeedNoWork) {
  const std::vector<Sphere> spheres = generate("gas:n=4000").spheres;
  const std::vector<Sphere> copy = spheres;
  Player player = on_cpu(moving());
  EXPECT_FALSE(player.check({spheres}, "first").reused);
  const Counts counts = player.check({copy}, "second");
  EXPECT_EQ(counts.reused, Skip::unchanged);
  EXPECT_EQ(counts.candidates, 0U);
  EXPECT_EQ(counts.uncertain_pairs, 0U);
  EXPECT_TRUE(ran(player.times(), Stage::bounds));
  for (const Stage stage :
       {Stage::cell_ids, Stage::sort, Stage::cell_index, Stage::pair_tests, Stage::resolve}) {
    EXPECT_FALSE(ran(player.times(), stage)) << name_of(stage);
  }
}

TEST(Unchanged, IsNotClaimedWhereItIsForbiddenOrNothingWillMove) {
  const std::vector<Sphere> spheres = generate("gas:n=3000").spheres;
  PlanOptions at_rest = moving();
  at_rest.moving = false;
  PlanOptions counting = moving();
  counting.count_only = true;
  PlanOptions other_method = moving();
  other_method.method = Method::home_phantom;
  const Skips none_of_the_kind =
      Skips::all().without(Skip::unchanged).without(Skip::few_movers).without(Skip::skin);
  for (const PlanOptions& options : {moving(none_of_the_kind), at_rest, counting, other_method}) {
    const std::unique_ptr<PairFinder> finder = cpu::make_backend();
    find_completely(*finder, {spheres}, options);
    HostClock clock;
    finder->find_pairs(clock);
    EXPECT_FALSE(finder->counts().reused);
    EXPECT_GT(finder->counts().candidates, 0U);
  }
}

/// What bytes show and values do not: -0 is 0. And the least that a coordinate can change.
TEST(Unchanged, NoticesEveryBitOfEverySphere) {
  const std::vector<Sphere> start = generate("lattice:n=1000").spheres;
  Player player = on_cpu(moving());
  player.check({start}, "start");
  for (std::size_t i = 0; i < start.size(); i += 111) {
    for (int field = 0; field < 4; ++field) {
      std::vector<Sphere> spheres = start;
      float Sphere::*const member[] = {&Sphere::x, &Sphere::y, &Sphere::z, &Sphere::r};
      float& value = spheres[i].*member[field];
      value = std::nextafter(value, field == 3 ? 0.0F : -1e9F);
      EXPECT_NE(player.check({spheres}, "an ulp").reused, Skip::unchanged);
      EXPECT_NE(player.check({start}, "back again").reused, Skip::unchanged);
      EXPECT_EQ(player.check({start}, "still").reused, Skip::unchanged);
    }
  }
}

TEST(Unchanged, AFrameThatFailedIsNoGround) {
  const std::vector<Sphere> start = generate("gas:n=2000").spheres;
  const std::unique_ptr<PairFinder> finder = cpu::make_backend();
  Plan plan = plan_scene({start}, moving());
  plan.capacity.pairs = 0;
  finder->upload(plan, {start});
  HostClock clock;
  for (int frame = 0; frame < 3; ++frame) {
    finder->find_pairs(clock);
    EXPECT_FALSE(finder->counts().reused) << "a list that was too small holds no pairs";
    EXPECT_GT(finder->counts().pairs, 0U);
  }
  std::vector<Sphere> outside = start;
  outside[7].x = 1e6F;
  finder->upload(plan_scene({start}, moving()), {start});
  for (int frame = 0; frame < 3; ++frame) {
    finder->update({outside});
    finder->find_pairs(clock);
    EXPECT_TRUE(finder->counts().plan_violation);
    EXPECT_FALSE(finder->counts().reused);
  }
  finder->update({start});
  finder->find_pairs(clock);
  EXPECT_EQ(finder->digest(), digest_of(reference::exact_pairs(start)));
}

TEST(Skin, TestsTheNearPairsAndNoOthers) {
  for (const char* spec : {"gas:n=20000", "poly:n=20000", "dense:n=20000"}) {
    const Frames frames = played(spec, Motion::slow, 25);
    Player player = on_cpu(moving());
    std::uint64_t near = 0;
    int searches = 0;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const Counts counts = player.check({frames[f]}, spec);
      if (!counts.reused) {
        ++searches;
        near = 0;
        continue;
      }
      EXPECT_EQ(counts.reused, Skip::skin) << spec;
      if (near == 0) near = counts.candidates;
      EXPECT_EQ(counts.candidates, near) << spec << ": one list, one length";
      EXPECT_LE(counts.candidates, 3 * counts.pairs + 20000) << spec;
      EXPECT_FALSE(ran(player.times(), Stage::sort));
      EXPECT_FALSE(ran(player.times(), Stage::cell_index));
      EXPECT_TRUE(ran(player.times(), Stage::pair_tests));
    }
    EXPECT_LE(searches, 4) << spec;
  }
}

TEST(Skin, ServesWhereMostStandStillAndTheOthersMoveLittle) {
  for (const Motion motion : {Motion::few, Motion::still}) {
    const Frames frames = played("gas:n=20000", motion, 12);
    Player player = on_cpu(moving(Skips::all().without(Skip::unchanged)));
    // Where none moves, nothing is cheaper than to look for those that do.
    const Skip expected = motion == Motion::few ? Skip::skin : Skip::few_movers;
    std::size_t served = 0;
    for (const Spheres& frame : frames) {
      if (player.check({frame}, "a frame").reused == expected) ++served;
    }
    EXPECT_GE(served, frames.size() / 2);
  }
}

TEST(Skin, ListsNoPairThatMayNotCollide) {
  const Scene scene = generate("gas:n=20000,static=0.9");
  const Frames frames = move(scene.spheres, Motion::brownian, 12, 1, scene.flags);
  Player with = on_cpu(moving());
  Player without = on_cpu(moving());
  Counts flagged;
  Counts all;
  for (const Spheres& frame : frames) {
    flagged = with.check({frame, scene.flags}, "with flags");
    all = without.check({frame}, "without");
  }
  EXPECT_EQ(flagged.reused, Skip::skin);
  EXPECT_EQ(all.reused, Skip::skin);
  EXPECT_LT(flagged.candidates, all.candidates / 2);
}

TEST(Skin, LastsLongerWhereMostAreStatic) {
  const Scene scene = generate("gas:n=20000,static=0.9");
  const Frames frames = move(scene.spheres, Motion::brownian, 60, 1, scene.flags);
  const auto searches = [&](const AllFlags& flags) {
    Player player = on_cpu(moving());
    int count = 0;
    for (const Spheres& frame : frames) count += player.show({frame, flags}).reused ? 0 : 1;
    return count;
  };
  EXPECT_LE(2 * searches(scene.flags), searches({}));
}

TEST(Skin, IsLeftByTheLeastStepOfAStaticSphere) {
  const Scene scene = generate("gas:n=5000,static=0.9");
  Frames frames = move(scene.spheres, Motion::slow, 12, 1, scene.flags);
  const auto moved =
      static_cast<std::size_t>(std::ranges::find_if(scene.flags, is_static) - scene.flags.begin());
  for (std::size_t f = 8; f < frames.size(); ++f) {
    frames[f][moved].z = std::nextafter(frames[f][moved].z, -1e9F);
  }
  Player player = on_cpu(moving());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Counts counts = player.check({frames[f], scene.flags}, "a frame");
    if (f >= 2) {
      EXPECT_EQ(counts.reused == Skip::skin, f != 8) << f;
    }
  }
}

/// It flies through the others, which creep; the wider its steps, the fewer frames a list lasts.
TEST(Skin, IsLeftByASingleSphere) {
  for (const float step : {0.01F, 0.03F, 0.3F}) {
    Frames frames = played("gas:n=3000", Motion::slow, 30);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      frames[f][1111].x = frames[0][1111].x + step * static_cast<float>(f);
    }
    Player player = on_cpu(moving());
    int served = 0;
    for (const Spheres& spheres : frames) {
      served += player.check({spheres}, "one flies").reused == Skip::skin ? 1 : 0;
    }
    if (step == 0.01F) {
      EXPECT_GT(served, 10);
    }
    if (step == 0.3F) {
      EXPECT_EQ(served, 0) << "no skin is as wide: 0.4 of the radius, 0.5";
    }
  }
}

TEST(Skin, IsNotWornWhereAllAreSomewhereElse) {
  Player player = on_cpu(moving());
  for (const Spheres& spheres : teleports("gas:n=3000", 1.0)) {
    EXPECT_FALSE(player.check({spheres}, "teleports").reused);
  }
}

TEST(Skin, ThatServesNobodyIsNotTriedAgainSoon) {
  constexpr FrameMotion kSlow = {.still_share = 0.0F, .farthest = 0.01F};
  SkinWidth skin;
  skin.reset(0.2F);
  int made = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    const std::optional<float> half_skin = skin.half_skin_for(kSlow);
    if (!half_skin) continue;
    EXPECT_LE(*half_skin, 0.2F);
    ++made;
    skin.made(*half_skin, kSlow);
    skin.left();
  }
  EXPECT_GE(made, 3);
  EXPECT_LE(made, 10);
}

TEST(Skin, IsNoUseWhereMotionIsFast) {
  SkinWidth skin;
  skin.reset(0.2F);
  EXPECT_FALSE(skin.half_skin_for({.still_share = 0.0F, .farthest = 1.0F}));
  EXPECT_TRUE(skin.half_skin_for({.still_share = 0.0F, .farthest = 0.001F}));
}

}  // namespace
}  // namespace octocell
