// SPDX-License-Identifier: MIT
// Method tiles of impl_cuda_custom against the exact pairs: any tiles, full tiles and what follows,
// all of a run's ways. Needs a CUDA device; without one every test says why it was skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/not_recorded.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cuda_custom/backend.hpp"

namespace octocell {
namespace {

struct Golden {
  const char* scene;
  std::uint64_t count;
  std::uint64_t checksum;
};
constexpr Golden kGolden[] = {
#include "tests/support/golden_checksums.inc"
};

constexpr PlanOptions kTiles = {.method = Method::tiles};

class TilesOnDevice : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto reason = cuda_custom::why_unavailable()) GTEST_SKIP() << *reason;
    finder_ = cuda_custom::make_backend();
  }

  /// Compares with the reference. Returns the method of the last plan.
  Method expect_the_exact_pairs(const Scene& scene, const PlanOptions& options = kTiles) {
    const Outcome outcome = find_completely(*finder_, scene.view(), options);
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres, scene.flags));
    EXPECT_EQ(finder_->digest(), truth) << scene.spec;
    EXPECT_EQ(outcome.counts.plan_violation, std::nullopt) << scene.spec;
    if (outcome.plan.method == Method::tiles) {
      EXPECT_GE(outcome.counts.candidates, truth.count) << scene.spec;
    }
    return outcome.plan.method;
  }

  std::unique_ptr<PairFinder> finder_;
};

TEST_F(TilesOnDevice, GoldenChecksums) {
  for (const Golden& golden : kGolden) {
    find_completely(*finder_, generate(golden.scene).view(), kTiles);
    EXPECT_EQ(finder_->digest(), (PairDigest{golden.count, golden.checksum})) << golden.scene;
  }
}

TEST_F(TilesOnDevice, EverySceneOfAnySizeIsExact) {
  for (const SceneInfo& info : scenes()) {
    for (const char* n : {"0", "1", "2", "31", "32", "33", "511", "512", "513", "1025", "4097"}) {
      expect_the_exact_pairs(generate(std::string(info.name) + ":n=" + n));
    }
  }
}

TEST_F(TilesOnDevice, LargeScenesAreExactAndStayInTiles) {
  for (const char* spec : {"gas:n=200000", "gas:n=1000003", "dense:n=300000", "lattice:n=250047",
                           "shifted:n=100000", "poly:n=100000"}) {
    EXPECT_EQ(expect_the_exact_pairs(generate(spec)), Method::tiles) << spec;
  }
}

/// The guarded filter, and pairs that are all uncertain.
TEST_F(TilesOnDevice, TangentSpheresAreResolved) {
  for (const char* spec : {"lattice:n=4096", "lattice:n=50653"}) {
    PlanOptions options = kTiles;
    for (const Skip skip : {Skip::uncertain_pairs, Skip::safe_filter}) {
      options.allowed = options.allowed.without(skip);
      const Scene scene = generate(spec);
      EXPECT_EQ(expect_the_exact_pairs(scene, options), Method::tiles) << spec;
      EXPECT_GT(finder_->counts().uncertain_pairs, scene.spheres.size()) << spec;
    }
  }
}

TEST_F(TilesOnDevice, ScenesFarAwayAndBelowZeroAreExact) {
  for (const float by : {-1.5F, 1e3F, -1e6F, 1e9F, 3e18F}) {
    Scene scene = generate("gas:n=20000");
    for (Sphere& s : scene.spheres) s = {s.x + by, s.y - by, s.z + by / 2, s.r};
    scene.spec += " by " + std::to_string(by);
    expect_the_exact_pairs(scene);
  }
}

/// Unequal radii are found by the largest, then tested one by one.
TEST_F(TilesOnDevice, RadiiMayDiffer) {
  Scene scene = generate("gas:n=30000");
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    scene.spheres[i].r *= 1.0F - 0.1F * static_cast<float>(i % 7) / 7.0F;
  }
  EXPECT_EQ(expect_the_exact_pairs(scene), Method::tiles);
  for (const char* spec : {"poly:n=20000", "giant:n=2000", "discs:n=20000", "cluster:n=20000"}) {
    expect_the_exact_pairs(generate(spec));
  }
  for (Sphere& s : scene.spheres) s.r = 0.0F;
  scene.spheres[17] = scene.spheres[20111];
  EXPECT_EQ(expect_the_exact_pairs(scene), Method::tiles);
}

/// Cuts the planned grid into tiles of those widths, with room as for all spheres in one.
PairDigest found_with_widths(PairFinder& finder, const Scene& scene,
                             const std::uint32_t (&widths)[3]) {
  Plan plan = make_plan(measure(scene.view()), kTiles);
  for (int a = 0; a < 3; ++a) {
    plan.tiles.width[a] = cell_width(widths[a]);
    plan.tiles.count[a] = (plan.tiles.grid.cell_count[a] - 1) / widths[a] + 1;
  }
  if (plan.tiles.tile_count() > kMostTiles) return {};
  plan.capacity.tile_records = 8;  // grows
  HostClock clock;
  EXPECT_EQ(complete(finder, scene.view(), plan, clock).plan.method, Method::tiles);
  return finder.digest();
}

/// Tiles of one cell give each sphere up to seven copies: more than blocks can stage.
TEST_F(TilesOnDevice, AnyTilesAreExact) {
  for (const char* spec : {"gas:n=3000", "dense:n=3000", "lattice:n=3375", "discs:n=3000"}) {
    const Scene scene = generate(spec);
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
    constexpr std::uint32_t kWidths[][3] = {{1, 1, 1}, {2, 2, 2}, {3, 1, 2}, {1, 13, 1}, {9, 7, 8}};
    for (const auto& widths : kWidths) {
      const PairDigest found = found_with_widths(*finder_, scene, widths);
      if (found == PairDigest{}) continue;
      EXPECT_EQ(found, truth) << spec << ", " << widths[0] << " x " << widths[1] << " x "
                              << widths[2];
    }
  }
}

/// The number of spheres at which a block's chunk, or a round of all blocks, is full.
TEST_F(TilesOnDevice, ScenesAroundTheSizesOfChunksAreExact) {
  for (const char* n : {"33791", "33792", "33793", "135168", "135169", "1081344", "1081345"}) {
    const Scene scene = generate(std::string("gas:n=") + n);
    find_completely(*finder_, scene.view(), {.method = Method::half_shell});
    const PairDigest truth = finder_->digest();
    find_completely(*finder_, scene.view(), kTiles);
    EXPECT_EQ(finder_->digest(), truth) << n;
  }
}

/// A crowd in one cell: up to what a tile holds there is a search in tiles, then another method.
TEST_F(TilesOnDevice, CoincidentSpheresAreAllPaired) {
  for (const std::uint64_t n : {300, 2000, 4096, 4097, 20000}) {
    const std::vector<Sphere> spheres(n, Sphere{1.0F, -2.0F, 3.0F, 0.5F});
    const Outcome outcome = find_completely(*finder_, {spheres}, kTiles);
    EXPECT_EQ(outcome.counts.pairs, n * (n - 1) / 2);
    EXPECT_EQ(outcome.plan.method == Method::tiles, n <= kMostTileRecords) << n;
  }
}

TEST_F(TilesOnDevice, AFullTileIsNeverClipped) {
  Scene scene = generate("gas:n=50000");
  const Scene crowd = generate("dense:n=6000");
  for (std::size_t i = 0; i < crowd.spheres.size(); ++i) {
    const Sphere& s = crowd.spheres[i];
    scene.spheres[i] = {s.x / 6, s.y / 6, s.z / 6, scene.spheres[0].r};
  }
  EXPECT_EQ(expect_the_exact_pairs(scene), Method::half_shell);
  expect_the_exact_pairs(generate("cluster:n=100000"));
}

TEST_F(TilesOnDevice, GrowsFromNothing) {
  const Scene scene = generate("dense:n=30000");
  Plan nothing = make_plan(measure(scene.view()), kTiles);
  nothing.capacity = {};
  HostClock clock;
  const Outcome outcome = complete(*finder_, scene.view(), nothing, clock);
  EXPECT_GT(outcome.runs, 1);
  EXPECT_EQ(outcome.plan.method, Method::tiles);
  EXPECT_EQ(finder_->digest(), digest_of(reference::exact_pairs(scene.spheres)));
}

TEST_F(TilesOnDevice, CountsWithoutStoring) {
  for (const char* spec : {"dense:n=30000", "lattice:n=4096", "poly:n=10000", "identical:n=1500"}) {
    const Scene scene = generate(spec);
    PlanOptions options = kTiles;
    options.count_only = true;
    options.allowed = options.allowed.without(Skip::uncertain_pairs);
    const Outcome outcome = find_completely(*finder_, scene.view(), options);
    EXPECT_EQ(finder_->digest(), digest_of(reference::exact_pairs(scene.spheres))) << spec;
    EXPECT_EQ(outcome.plan.method, Method::tiles) << spec;
  }
}

TEST_F(TilesOnDevice, FlagsForbidPairs) {
  expect_the_exact_pairs(generate("dense:n=20000,static=0.5,groups=3"));
  expect_the_exact_pairs(generate("lattice:n=8000,static=0.3"));
  expect_the_exact_pairs(generate("gas:n=5000,static=1"));
}

TEST_F(TilesOnDevice, StopsBeyondTheCandidateLimit) {
  PlanOptions options = kTiles;
  options.candidate_limit = 1000;
  const Outcome outcome = find_completely(*finder_, generate("dense:n=50000").view(), options);
  EXPECT_TRUE(outcome.counts.over_candidate_limit);
}

TEST_F(TilesOnDevice, ViolationsAreReported) {
  const Scene scene = generate("gas:n=3000");
  find_completely(*finder_, scene.view(), kTiles);
  HostClock clock;
  const auto violation_after = [&](Sphere s) {
    Scene changed = scene;
    changed.spheres[2000] = s;
    finder_->update(changed.view());
    finder_->find_pairs(clock);
    const Counts counts = finder_->counts();
    EXPECT_EQ(counts.pairs == 0, counts.plan_violation.has_value());
    return counts.plan_violation.value_or("nothing");
  };
  const Sphere s = scene.spheres[2000];
  EXPECT_NE(violation_after({1e6F, 0, 0, s.r}).find("have left the box"), std::string::npos);
  EXPECT_NE(violation_after({s.x, s.y, s.z, s.r / 2}).find("range of radii"), std::string::npos);
  EXPECT_NE(violation_after({s.x, s.y, s.z, -1.0F}).find("sphere 2000:"), std::string::npos);
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(violation_after({0, not_a_number, 0, 1}).find("sphere 2000:"), std::string::npos);
  EXPECT_EQ(violation_after(s), "nothing");
}

/// A plan made for frames has a larger box, and its spheres may crowd into tiles that were empty.
TEST_F(TilesOnDevice, FramesAreExact) {
  PlanOptions options = kTiles;
  options.moving = true;
  Scene scene = generate("gas:n=30000");
  Plan plan = find_completely(*finder_, scene.view(), options).plan;
  ASSERT_EQ(plan.method, Method::tiles);
  HostClock clock;
  for (int frame = 0; frame < 10; ++frame) {
    for (Sphere& s : scene.spheres) {
      s.x += 0.05F * std::sin(s.y + static_cast<float>(frame));
      s.z *= 0.98F;
    }
    finder_->update(scene.view());
    finder_->find_pairs(clock);
    const Counts counts = finder_->counts();
    if (!fits(counts, plan.capacity, false)) {
      plan = complete(*finder_, scene.view(), grow(plan, counts), clock).plan;
    }
    ASSERT_EQ(finder_->counts().plan_violation, std::nullopt);
    EXPECT_EQ(finder_->digest(), digest_of(reference::exact_pairs(scene.spheres))) << frame;
  }
}

TEST_F(TilesOnDevice, FindTheSameSetAThousandTimes) {
  find_completely(*finder_, generate("dense:n=100000").view(), kTiles);
  const PairDigest first = finder_->digest();
  HostClock clock;
  for (int time = 0; time < 1000; ++time) {
    finder_->find_pairs(clock);
    ASSERT_EQ(finder_->digest(), first) << "time " << time;
  }
}

TEST_F(TilesOnDevice, AnswerTheSameAsAGraphAndWithTransfers) {
  const Scene scene = generate("dense:n=30000");  // transfers copy it again
  find_completely(*finder_, scene.view(), kTiles);
  const PairDigest first = finder_->digest();
  EXPECT_EQ(first, digest_of(reference::exact_pairs(scene.spheres)));
  DeviceRuns& runs = *finder_->device_runs();
  for (int time = 0; time < 3; ++time) {
    EXPECT_GT(runs.replay_ms(), 0.0);
    EXPECT_EQ(finder_->digest(), first);
    EXPECT_GT(runs.transfers_ms(), 0.0);
    EXPECT_EQ(finder_->digest(), first);
    runs.flush_cache();
  }
}

TEST_F(TilesOnDevice, ARecordSaysWhyItLacksArrays) {
  RunRecord record;
  finder_->record(&record);
  const Scene scene = generate("dense:n=500");
  find_completely(*finder_, scene.view(), kTiles);
  EXPECT_FALSE(record.ids.cell_ids.exists);
  EXPECT_EQ(record.ids.cell_ids.why_not, not_recorded::kTilesInstead);
  EXPECT_FALSE(record.sorted.objects.exists);
  EXPECT_FALSE(record.cells.exists);
  EXPECT_FALSE(record.considered.exists);
  EXPECT_TRUE(record.certain.exists);
  EXPECT_EQ(finder_->digest(), digest_of(reference::exact_pairs(scene.spheres)));
}

TEST_F(TilesOnDevice, NameTheStageThatHoldsBounds) {
  const Outcome outcome = find_completely(*finder_, generate("gas:n=5000").view(), kTiles);
  EXPECT_TRUE(outcome.times.stage_ms[index_of(Stage::bounds)]);
  EXPECT_EQ(outcome.times.fused_into[index_of(Stage::cell_ids)], Stage::bounds);
  EXPECT_FALSE(outcome.times.stage_ms[index_of(Stage::sort)]);
  EXPECT_TRUE(outcome.times.stage_ms[index_of(Stage::pair_tests)]);
}

}  // namespace
}  // namespace octocell
