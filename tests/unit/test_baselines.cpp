// SPDX-License-Identifier: MIT
// Every baseline gives the exact pair set, whatever it searched before, and reports buffers that
// were too small.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "baselines/baselines.hpp"
#include "core/overlap.hpp"

namespace octocell {
namespace {

using Spheres = std::vector<Sphere>;

struct Baseline {
  const char* name;
  std::unique_ptr<PairFinder> (*create)();
  /// Where and how it was built is fixed, so that spheres that leave mean rebuilding.
  bool fixed_world = false;
  /// Compares far more pairs than it reports, and is stopped before it starts.
  bool stops_beforehand = false;
};

const Baseline kBaselines[] = {
    {"fcl_dynamic_aabb_tree", baselines::make_fcl_dynamic_aabb_tree},
    {"fcl_dynamic_aabb_tree_morton", baselines::make_fcl_dynamic_aabb_tree_morton},
    {"fcl_dynamic_aabb_tree_array", baselines::make_fcl_dynamic_aabb_tree_array},
    {"fcl_dynamic_aabb_tree_array_morton", baselines::make_fcl_dynamic_aabb_tree_array_morton},
    {"bullet_dbvt_broadphase", baselines::make_bullet_dbvt_broadphase},
    {"bullet_dbvt_broadphase_deferred", baselines::make_bullet_dbvt_broadphase_deferred},
    {"bullet_dbvt", baselines::make_bullet_dbvt},
    {"fcl_ssap", baselines::make_fcl_ssap, false, true},
    {"fcl_naive", baselines::make_fcl_naive, false, true},
    {"bullet_axis_sweep", baselines::make_bullet_axis_sweep, true, true},
    {"bullet_axis_sweep_32", baselines::make_bullet_axis_sweep_32, true, true},
    {"bullet_simple", baselines::make_bullet_simple, false, true},
};

std::vector<Pair> brute_force(const Spheres& spheres) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    for (std::uint32_t j = i + 1; j < spheres.size(); ++j) {
      if (overlap_exact(spheres[i], spheres[j])) pairs.push_back({i, j});
    }
  }
  return pairs;
}

/// Spheres in a cube of which they fill about 10 %, so that most touch nothing and some do.
Spheres gas(std::size_t count, float r_min, float r_max, unsigned seed = 1) {
  std::mt19937 random(seed);
  const float r = (r_min + r_max) / 2;
  const float side = 3.5F * r * std::cbrt(static_cast<float>(count) + 1.0F);
  std::uniform_real_distribution<float> place(0.0F, side);
  std::uniform_real_distribution<float> radius(r_min, r_max);
  Spheres spheres(count);
  for (Sphere& s : spheres) s = {place(random), place(random), place(random), radius(random)};
  return spheres;
}

/// Every sphere touches its 6 neighbours at exactly one point.
Spheres tangent_lattice(int side, float offset) {
  Spheres spheres;
  for (int i = 0; i < side * side * side; ++i) {
    const auto x = static_cast<float>(i % side);
    const auto y = static_cast<float>(i / side % side);
    const auto z = static_cast<float>(i / side / side);
    spheres.push_back({offset + x, offset + y, offset + z, 0.5F});
  }
  return spheres;
}

Spheres shifted(Spheres spheres, float by) {
  for (Sphere& s : spheres) s = {s.x + by, s.y - by, s.z + by, s.r};
  return spheres;
}

Spheres jiggled(Spheres spheres, float by, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> step(0.0F, by);
  for (Sphere& s : spheres) s = {s.x + step(random), s.y + step(random), s.z + step(random), s.r};
  return spheres;
}

class Baselines : public testing::TestWithParam<Baseline> {
 protected:
  static Plan roomy_plan() {
    Plan plan;
    plan.capacity.pairs = 1'000'000;
    return plan;
  }

  void upload(const Spheres& spheres, const Plan& plan = roomy_plan()) {
    finder_->upload(plan, {spheres});
  }

  StageTimes find() {
    HostClock clock;
    finder_->find_pairs(clock);
    return clock.stop();
  }

  void expect_exact(const Spheres& spheres) {
    const std::vector<Pair> expected = brute_force(spheres);
    const Counts counts = finder_->counts();
    EXPECT_EQ(counts.plan_violation, std::nullopt);
    EXPECT_FALSE(counts.over_candidate_limit);
    EXPECT_EQ(counts.pairs, expected.size());
    EXPECT_GE(counts.candidates, counts.pairs);
    EXPECT_EQ(finder_->download(), expected);
    EXPECT_EQ(finder_->digest(), digest_of(expected));
  }

  void expect_exact_after_build(const Spheres& spheres) {
    upload(spheres);
    const StageTimes times = find();
    EXPECT_TRUE(times.stage_ms[index_of(Stage::build)].has_value());
    EXPECT_FALSE(times.stage_ms[index_of(Stage::update)].has_value());
    EXPECT_TRUE(times.stage_ms[index_of(Stage::query)].has_value());
    expect_exact(spheres);
  }

  void expect_exact_after_update(const Spheres& spheres) {
    finder_->update({spheres});
    const StageTimes times = find();
    const bool built = times.stage_ms[index_of(Stage::build)].has_value();
    EXPECT_NE(times.stage_ms[index_of(Stage::update)].has_value(), built);
    EXPECT_TRUE(!built || GetParam().fixed_world);
    expect_exact(spheres);
  }

  std::unique_ptr<PairFinder> finder_ = GetParam().create();
};

TEST_P(Baselines, FindEveryPairOfAGasOfAnySize) {
  for (const std::size_t count : {0, 1, 2, 33, 1000}) {
    expect_exact_after_build(gas(count, 0.5F, 0.5F));
  }
}

TEST_P(Baselines, FindEveryPairOfUnequalSpheres) {
  expect_exact_after_build(gas(1000, 0.0F, 2.0F));
}

TEST_P(Baselines, FindEveryPairOfAGiantAmongDust) {
  Spheres spheres = gas(1000, 0.01F, 0.01F);
  spheres[500].r = 1000.0F;
  expect_exact_after_build(spheres);
}

TEST_P(Baselines, FindEveryPairOfCoincidentSpheres) {
  expect_exact_after_build(Spheres(300, {1.0F, 2.0F, 3.0F, 0.5F}));
}

TEST_P(Baselines, FindPointsThatCoincide) {
  expect_exact_after_build(Spheres(2, {0.1F, 0.2F, 0.3F, 0.0F}));
  expect_exact_after_build({{0, 0, 0, 0}, {0, 0, 0x1p-149F, 0}, {0, 0, 0, 0}});
}

TEST_P(Baselines, FindTangentSpheresWhereverTheyLie) {
  for (const float offset : {0.0F, -4.5F, 0x1p20F, 0x1p23F}) {
    const Spheres lattice = tangent_lattice(9, offset);
    expect_exact_after_build(lattice);
    EXPECT_EQ(finder_->counts().pairs, 3U * 9 * 9 * 8);
  }
}

TEST_P(Baselines, FindEveryPairFarFromTheOrigin) {
  for (const float by : {1e5F, 1e6F, 1e7F}) {
    expect_exact_after_build(shifted(gas(1000, 0.5F, 0.5F), by));
  }
}

TEST_P(Baselines, FindEveryPairAtTheEndsOfTheFloatRange) {
  Spheres dust = gas(300, 0.5F, 0.5F);
  for (Sphere& s : dust) s = {s.x * 1e-39F, s.y * 1e-39F, s.z * 1e-39F, s.r * 1e-39F};
  expect_exact_after_build(dust);
  Spheres huge = gas(300, 0.5F, 0.5F);
  for (Sphere& s : huge) s = {s.x * 1e37F, -s.y * 1e37F, s.z * 1e37F, s.r * 1e37F};
  huge.push_back({3e38F, 3e38F, -3e38F, 3e38F});
  huge.push_back({0, 0, 0, kFloatMax});
  expect_exact_after_build(huge);
}

TEST_P(Baselines, FindTheSameAgainFromNothing) {
  const Spheres spheres = gas(1000, 0.2F, 0.8F);
  upload(spheres);
  find();
  const Counts first = finder_->counts();
  const StageTimes times = find();
  EXPECT_TRUE(times.stage_ms[index_of(Stage::build)].has_value());
  EXPECT_EQ(finder_->counts().candidates, first.candidates);
  expect_exact(spheres);
}

TEST_P(Baselines, TakeAnotherSceneAfterTheFirst) {
  expect_exact_after_build(gas(1000, 0.5F, 0.5F));
  expect_exact_after_build(gas(33, 0.1F, 0.9F, 2));
}

TEST_P(Baselines, FollowMovingSpheres) {
  for (const std::size_t count : {0, 1, 2, 33, 1000}) {
    Spheres spheres = gas(count, 0.2F, 0.8F);
    upload(spheres);
    find();
    for (unsigned frame = 0; frame < 5; ++frame) {
      spheres = jiggled(spheres, frame < 3 ? 0.05F : 3.0F, frame);
      expect_exact_after_update(spheres);
    }
  }
}

TEST_P(Baselines, FollowChangingRadii) {
  Spheres spheres = gas(1000, 0.2F, 0.8F);
  upload(spheres);
  find();
  for (const float factor : {1.3F, 0.5F, 1.0F, 2.0F}) {
    for (std::size_t i = 0; i < spheres.size(); i += 2) spheres[i].r *= factor;
    expect_exact_after_update(spheres);
  }
}

TEST_P(Baselines, StartAnewIfUpdatedBeforeTheFirstFind) {
  const Spheres before = gas(100, 0.5F, 0.5F);
  const Spheres after = jiggled(before, 1.0F, 7);
  upload(before);
  finder_->update({after});
  EXPECT_TRUE(find().stage_ms[index_of(Stage::build)].has_value());
  expect_exact(after);
}

TEST_P(Baselines, BuildFromNothingAfterAnUpdate) {
  const Spheres before = gas(1000, 0.2F, 0.8F);
  const Spheres after = jiggled(before, 0.5F, 3);
  upload(before);
  find();
  const float step = GetParam().fixed_world ? 0.5F : 9.0F;
  finder_->update({jiggled(before, step, 4)});  // never looked at
  finder_->update({after});
  EXPECT_TRUE(find().stage_ms[index_of(Stage::update)].has_value());
  EXPECT_TRUE(find().stage_ms[index_of(Stage::build)].has_value());
  expect_exact(after);
}

TEST_P(Baselines, FollowSpheresWiderThanTheFloatRange) {
  Spheres spheres = gas(100, 0.5F, 0.5F);
  spheres[7].r = kFloatMax;
  upload(spheres);
  find();
  for (unsigned frame = 0; frame < 2; ++frame) {
    const Spheres moved = jiggled(spheres, 0.5F, frame);
    finder_->update({moved});
    find();
    expect_exact(moved);
  }
}

TEST_P(Baselines, SayHowMuchRoomPairsNeed) {
  const Spheres spheres = gas(1000, 0.5F, 0.5F);
  const std::vector<Pair> expected = brute_force(spheres);
  ASSERT_GT(expected.size(), 10U);
  for (const std::uint64_t room : {std::uint64_t{0}, std::uint64_t{5}, expected.size() - 1}) {
    Plan plan;
    plan.capacity.pairs = room;
    upload(spheres, plan);
    find();
    EXPECT_EQ(finder_->counts().pairs, expected.size());
    EXPECT_FALSE(fits(finder_->counts(), plan.capacity, plan.count_only));
    EXPECT_EQ(finder_->download().size(), room);
    EXPECT_EQ(finder_->digest(), digest_of(expected));
  }
}

TEST_P(Baselines, OnlyCountIfAskedTo) {
  const Spheres spheres = gas(1000, 0.5F, 0.5F);
  Plan plan;
  plan.count_only = true;
  upload(spheres, plan);
  find();
  EXPECT_EQ(finder_->digest(), digest_of(brute_force(spheres)));
  EXPECT_TRUE(finder_->download().empty());
}

TEST_P(Baselines, StopAtTheCandidateLimitAndRecover) {
  const Spheres crowd(1000, {0.0F, 0.0F, 0.0F, 1.0F});
  Plan plan = roomy_plan();
  plan.candidate_limit = 100;
  upload(crowd, plan);
  find();
  EXPECT_TRUE(finder_->counts().over_candidate_limit);
  EXPECT_GT(finder_->counts().candidates, plan.candidate_limit);
  EXPECT_LE(finder_->counts().pairs, plan.candidate_limit);

  const Spheres apart = tangent_lattice(10, 0.0F);
  finder_->update({apart});
  find();
  EXPECT_TRUE(finder_->counts().over_candidate_limit);
  upload(apart);
  find();
  expect_exact(apart);
}

TEST_P(Baselines, DoNotStopAtExactlyTheCandidateLimit) {
  const Spheres spheres = gas(1000, 0.5F, 0.5F);
  upload(spheres);
  find();
  Plan plan = roomy_plan();
  const std::uint64_t all_pairs = spheres.size() * (spheres.size() - 1) / 2;
  plan.candidate_limit = GetParam().stops_beforehand ? all_pairs : finder_->counts().candidates;
  upload(spheres, plan);
  find();
  expect_exact(spheres);
}

INSTANTIATE_TEST_SUITE_P(All, Baselines, testing::ValuesIn(kBaselines),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace octocell
