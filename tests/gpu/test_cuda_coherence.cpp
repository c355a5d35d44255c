// SPDX-License-Identifier: MIT
// Frames that reuse data of the last one on a GPU: every frame of every sequence has the exact pair
// set, whatever is allowed, with and without flags. Needs a CUDA device; without one every test
// says why it was skipped.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "harness/scenes/scenes.hpp"
#include "impl_cuda_custom/backend.hpp"
#include "tests/support/frame_player.hpp"
#include "tests/support/random_player.hpp"

namespace octocell {
namespace {

class FramesOnDevice : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto reason = cuda_custom::why_unavailable()) GTEST_SKIP() << *reason;
  }
  static Player on_device(const PlanOptions& options) {
    return {options, cuda_custom::make_backend()};
  }
};

class CoherenceOnDevice : public FramesOnDevice, public testing::WithParamInterface<double> {};

/// The parameter: the share of static spheres; none, below zero, no flags.
TEST_P(CoherenceOnDevice, EveryFrameHasTheExactPairsWhateverIsAllowed) {
  Served served = {};
  play_with_every_choice(
      [](Skips allowed) { return on_device(moving(allowed)); },
      [](const Spheres& spheres) { return flags_of(spheres.size(), GetParam(), 11); }, served);
  // A static sphere that does move, as here, ends a list.
  expect_all_to_have_served({Skip::unchanged, Skip::skin}, served, GetParam() < 0.0 ? 50 : 40);
}

INSTANTIATE_TEST_SUITE_P(StaticShares, CoherenceOnDevice, testing::Values(-1.0, 0.3, 0.9));

/// Static spheres keep their places, as flags promise.
TEST_F(FramesOnDevice, WithStaticSpheresThatStayHaveTheExactPairs) {
  for (const char* spec : {"gas:n=20000", "dense:n=5000", "poly:n=5000"}) {
    const Spheres start = generate(spec).spheres;
    const AllFlags flags = flags_of(start.size(), 0.9, 12);
    for (const Motion motion : {Motion::brownian, Motion::slow, Motion::still, Motion::gravity}) {
      const Frames frames = move(start, motion, 12, 1, flags);
      Player player = on_device(moving());
      int served = 0;
      for (const Spheres& spheres : frames) {
        served += player.check({spheres, flags}, spec).reused ? 1 : 0;
      }
      EXPECT_TRUE(served >= 5 || motion == Motion::gravity) << spec << ": " << served;
    }
  }
}

TEST_F(FramesOnDevice, ThatAreUnchangedNeedNoSearch) {
  for (const char* spec : {"gas:n=20000", "poly:n=20000", "lattice:n=8000", "gas:n=3"}) {
    const Spheres spheres = generate(spec).spheres;
    Player player = on_device(moving());
    EXPECT_FALSE(player.check({spheres}, spec).reused);
    for (int frame = 0; frame < 3; ++frame) {
      const Spheres copy = spheres;
      const Counts counts = player.check({copy}, spec);
      EXPECT_EQ(counts.reused, Skip::unchanged) << spec;
      EXPECT_EQ(counts.candidates, 0U) << spec;
    }
  }
}

TEST_F(FramesOnDevice, ThatDifferByOneBitAreNotUnchanged) {
  const Spheres start = generate("gas:n=20000").spheres;
  Player player = on_device(moving());
  player.check({start}, "start");
  for (const std::size_t changed : {std::size_t{0}, std::size_t{10'007}, start.size() - 1}) {
    for (float Sphere::*const part : {&Sphere::x, &Sphere::z, &Sphere::r}) {
      Spheres spheres = start;
      spheres[changed].*part = std::nextafter(spheres[changed].*part, 0.0F);
      EXPECT_NE(player.check({spheres}, "an ulp").reused, Skip::unchanged);
      player.check({start}, "back again");
      player.check({start}, "still, and a copy is made");
      EXPECT_EQ(player.check({start}, "still").reused, Skip::unchanged);
    }
  }
}

TEST_F(FramesOnDevice, ThatMoveSlowlyTestTheNearPairsAndNoOthers) {
  for (const char* spec : {"gas:n=20000", "poly:n=20000", "dense:n=20000"}) {
    const Frames frames = played(spec, Motion::slow, 25);
    Player player = on_device(moving());
    int served = 0;
    for (const Spheres& spheres : frames) {
      const Counts counts = player.check({spheres}, spec);
      if (counts.reused != Skip::skin) continue;
      ++served;
      EXPECT_LE(counts.candidates, 4 * counts.pairs + 20000) << spec;
    }
    EXPECT_GE(served, 12) << spec;
  }
}

/// A frame is predicted to go like the last; a mispredicted one does afterwards what it left out.
TEST_F(FramesOnDevice, ThatAreSearchedAfterAllHaveTimesOfAllStages) {
  const Spheres start = generate("gas:n=20000").spheres;
  const Spheres other(start.rbegin(), start.rend());
  for (const Motion motion : {Motion::still, Motion::slow}) {
    const std::unique_ptr<PairFinder> finder = cuda_custom::make_backend();
    const std::unique_ptr<StageClock> clock = finder->make_clock(Marks::on);
    finder->upload(plan_scene({start}, moving()), {start});
    Frames frames = move(start, motion, 12, 1);
    frames.push_back(other);
    std::optional<Skip> served_before;
    std::optional<Skip> served;
    for (const Spheres& spheres : frames) {
      finder->update({spheres});
      finder->find_pairs(*clock);
      served_before = served;
      served = finder->counts().reused;
      EXPECT_EQ(finder->digest(), digest_of(reference::exact_pairs(spheres)));
    }
    EXPECT_EQ(served_before, motion == Motion::still ? Skip::unchanged : Skip::skin);
    EXPECT_FALSE(served);
    const StageTimes times = clock->stop();
    for (std::size_t stage = 0; stage <= index_of(Stage::resolve); ++stage) {
      EXPECT_TRUE(times.stage_ms[stage]) << kStageNames[stage];
    }
  }
}

TEST_F(FramesOnDevice, ThatFailedAreNoGround) {
  const Spheres start = generate("gas:n=2000").spheres;
  const std::unique_ptr<PairFinder> finder = cuda_custom::make_backend();
  const Plan roomy = plan_scene({start}, moving());
  HostClock clock;
  for (const bool pairs : {true, false}) {
    Plan plan = roomy;
    (pairs ? plan.capacity.pairs : plan.candidate_limit) = 7;
    finder->upload(plan, {start});
    for (int frame = 0; frame < 4; ++frame) {
      finder->find_pairs(clock);
      const Counts counts = finder->counts();
      EXPECT_FALSE(counts.reused) << "a list that was too small holds no pairs";
      EXPECT_EQ(counts.pairs > 0, pairs);
      EXPECT_EQ(counts.over_candidate_limit, !pairs);
    }
  }
  Spheres outside = start;
  outside[7].x = 1e6F;
  finder->upload(roomy, {start});
  const Spheres* const shown[] = {&start, &start, &outside, &outside, &start, &start};
  for (const Spheres* const spheres : shown) {
    finder->update({*spheres});
    finder->find_pairs(clock);
    const Counts counts = finder->counts();
    EXPECT_EQ(counts.plan_violation.has_value(), spheres == &outside);
    EXPECT_FALSE(counts.plan_violation && counts.reused);
    if (spheres == &start) {
      EXPECT_EQ(finder->digest(), digest_of(reference::exact_pairs(start)));
    }
  }
}

/// A list of uncertain pairs that is too short in a frame that the neighbor pairs serve.
TEST_F(FramesOnDevice, WithMoreUncertainPairsThanRoomAreNotComplete) {
  const Frames frames = by_an_ulp(0.05);
  Plan plan = plan_scene({frames[0]}, moving());
  plan.capacity.uncertain_pairs = 5;
  const std::unique_ptr<PairFinder> finder = cuda_custom::make_backend();
  finder->upload(plan, {frames[0]});
  HostClock clock;
  for (const Spheres& spheres : frames) {
    finder->update({spheres});
    finder->find_pairs(clock);
    const Counts counts = finder->counts();
    EXPECT_GT(counts.uncertain_pairs, plan.capacity.uncertain_pairs);
    EXPECT_FALSE(counts.reused);
  }
}

TEST_F(FramesOnDevice, OfAnotherNumberAreForgotten) {
  const Spheres start = generate("gas:n=2000").spheres;
  const Spheres fewer(start.begin(), start.begin() + 1500);
  const std::unique_ptr<PairFinder> finder = cuda_custom::make_backend();
  finder->upload(plan_scene({start}, moving()), {start});
  HostClock clock;
  for (const Spheres* spheres : {&start, &start, &fewer, &start, &start, &start}) {
    finder->update({*spheres});
    finder->find_pairs(clock);
    const Counts counts = finder->counts();
    EXPECT_EQ(counts.plan_violation.has_value(), spheres == &fewer);
    if (spheres == &start) {
      EXPECT_EQ(finder->digest(), digest_of(reference::exact_pairs(start)));
    }
  }
}

TEST_F(FramesOnDevice, WithOtherFlagsAreSearched) {
  const Frames frames = played("dense:n=5000", Motion::slow, 24);
  Player player = on_device(moving());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const std::size_t times_changed = f / 6;
    const AllFlags flags =
        times_changed == 1 ? AllFlags()
                           : flags_of(frames[f].size(), 0.3 * static_cast<double>(times_changed),
                                      static_cast<unsigned>(times_changed));
    const Counts counts = player.check({frames[f], flags}, "frame " + std::to_string(f));
    EXPECT_FALSE(f % 6 == 0 && counts.reused) << f;
  }
}

/// As a graph, recorded once, and with transfers: each run is a frame of its own.
TEST_F(FramesOnDevice, AreReplayedExactly) {
  for (const Motion motion : {Motion::slow, Motion::still, Motion::brownian}) {
    const Frames frames = played("gas:n=20000", motion, 16);
    const std::unique_ptr<PairFinder> finder = cuda_custom::make_backend();
    finder->upload(plan_scene({frames[0]}, moving()), {frames[0]});
    HostClock clock;
    for (const Spheres& spheres : frames) {
      const PairDigest truth = digest_of(reference::exact_pairs(spheres));
      finder->update({spheres});
      finder->device_runs()->replay_ms();
      EXPECT_EQ(finder->counts().pairs, truth.count);
      EXPECT_EQ(finder->digest(), truth);
      finder->find_pairs(clock);
      EXPECT_EQ(finder->counts().pairs, truth.count);
      EXPECT_EQ(finder->digest(), truth);
      finder->device_runs()->transfers_ms();
      EXPECT_EQ(finder->digest(), truth);
    }
  }
}

/// Neighbor pairs are more than candidates of a plain search may be: it is searched again without.
TEST_F(FramesOnDevice, AreNotRefusedForTheSakeOfASkin) {
  const Frames frames = played("gas:n=20000", Motion::slow, 12);
  Plan plan = plan_scene({frames[0]}, moving());
  const std::unique_ptr<PairFinder> finder = cuda_custom::make_backend();
  HostClock clock;
  finder->upload(plan, {frames[0]});
  finder->find_pairs(clock);
  plan.candidate_limit = finder->counts().candidates * 11 / 10;
  finder->upload(plan, {frames[0]});
  for (const Spheres& spheres : frames) {
    finder->update({spheres});
    finder->find_pairs(clock);
    EXPECT_FALSE(finder->counts().over_candidate_limit);
    EXPECT_EQ(finder->digest(), digest_of(reference::exact_pairs(spheres)));
  }
}

TEST_F(FramesOnDevice, ThatAreRandomHaveTheExactPairs) {
  play_random_frames(200, 6000, cuda_custom::make_backend, {Skip::unchanged, Skip::skin});
}

TEST_F(FramesOnDevice, ThatAreOnlyCountedAreSearched) {
  PlanOptions count = moving();
  count.count_only = true;
  const Spheres spheres = generate("gas:n=5000").spheres;
  Player player = on_device(count);
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_FALSE(player.show({spheres}).reused);
    EXPECT_EQ(player.finder().digest(), digest_of(reference::exact_pairs(spheres)));
  }
}

}  // namespace
}  // namespace octocell
