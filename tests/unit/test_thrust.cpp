// SPDX-License-Identifier: MIT
// Compares impl_thrust with impl_cpu: all counts are the same, with any number of threads. (Other
// tests check for all backends that pairs are exact, buffers report what they need, and checksums
// are as stored.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cpu/backend.hpp"
#include "impl_thrust/backend.hpp"
#include "impl_thrust/scratch.cuh"
#include "tests/support/ask_finder.hpp"
#include "tests/support/ways.hpp"

namespace octocell {
namespace {

void expect_same_results(const Counts& a, const Counts& b, const std::string& what) {
  EXPECT_EQ(a.ids, b.ids) << what;
  EXPECT_EQ(a.cells, b.cells) << what;
  EXPECT_EQ(a.pairs, b.pairs) << what;
  EXPECT_EQ(a.over_candidate_limit, b.over_candidate_limit) << what;
  EXPECT_EQ(a.plan_violation, b.plan_violation) << what;
}

void expect_same_counts(const Counts& a, const Counts& b, const std::string& what) {
  expect_same_results(a, b, what);
  EXPECT_EQ(a.candidates, b.candidates) << what;
  EXPECT_EQ(a.uncertain_pairs, b.uncertain_pairs) << what;
}

class Thrust : public testing::TestWithParam<Way> {
 protected:
  static PlanOptions options(int threads = 1) {
    return {.method = GetParam().method, .rule = GetParam().rule, .threads = threads};
  }
  std::unique_ptr<PairFinder> ours_ = on_thrust::make_host_backend();
  std::unique_ptr<PairFinder> cpu_ = cpu::make_backend();
};

TEST_P(Thrust, CountsWhatImplCpuCounts) {
  for (const char* spec : {"gas:n=0", "gas:n=1", "gas:n=2", "gas:n=5001", "dense:n=3000",
                           "poly:n=5000", "giant:n=3000", "lattice:n=2744"}) {
    const Scene scene = generate(spec);
    const FinderAnswer truth = ask(*cpu_, roomy_plan(scene, options()), scene.view());
    for (const int threads : {1, 2, 3, 7}) {
      const FinderAnswer answer = ask(*ours_, roomy_plan(scene, options(threads)), scene.view());
      if (GetParam().method == Method::half_shell) {
        // impl_cpu looks up the windows of several spheres as one, and leaves out what is far from
        // a row's border, so it meets other candidates.
        expect_same_results(answer.counts, truth.counts, spec);
      } else {
        expect_same_counts(answer.counts, truth.counts, spec);
      }
      EXPECT_EQ(answer.digest, truth.digest) << spec << ", " << threads << " threads";
      EXPECT_EQ(answer.pairs, truth.pairs) << spec << ", " << threads << " threads";
    }
  }
}

/// The capacity of each buffer, and the count that says what it should have been.
constexpr std::pair<std::uint64_t Capacities::*, std::uint64_t Counts::*> kBuffers[] = {
    {&Capacities::ids, &Counts::ids},
    {&Capacities::cells, &Counts::cells},
    {&Capacities::uncertain_pairs, &Counts::uncertain_pairs},
    {&Capacities::pairs, &Counts::pairs}};

TEST_P(Thrust, SaysWhatAFullBufferNeedsTheFirstTime) {
  for (const char* spec : {"dense:n=2000", "lattice:n=1000"}) {
    const Scene scene = generate(spec);
    const Plan roomy = roomy_plan(scene, options());
    const Counts needed = ask(*ours_, roomy, scene.view()).counts;
    for (const auto& [capacity, count] : kBuffers) {
      Plan small = roomy;
      small.capacity.*capacity = 1;
      const FinderAnswer answer = ask(*ours_, small, scene.view());
      EXPECT_EQ(answer.counts.*count, needed.*count) << spec;
      EXPECT_EQ(fits(answer.counts, small.capacity, false), needed.*count <= 1) << spec;
    }
  }
}

TEST_P(Thrust, GrowsFromNoBuffersAtAll) {
  for (const char* spec : {"dense:n=2000", "lattice:n=1000", "giant:n=1000"}) {
    const Scene scene = generate(spec);
    Plan plan = roomy_plan(scene, options());
    const PairDigest digest = ask(*ours_, plan, scene.view()).digest;
    plan.capacity = {};
    const auto finder = on_thrust::make_host_backend();
    EXPECT_EQ(ask_until_it_fits(*finder, plan, scene.view()).digest, digest) << spec;
    plan.count_only = true;
    const FinderAnswer counted = ask_until_it_fits(*finder, plan, scene.view());
    EXPECT_EQ(counted.digest, digest) << spec;
    EXPECT_TRUE(counted.pairs.empty()) << spec;
  }
}

TEST_P(Thrust, FindsTheSameAgain) {
  for (const char* spec : {"dense:n=5001", "poly:n=5000", "lattice:n=2744"}) {
    const Scene scene = generate(spec);
    const FinderAnswer first = ask(*ours_, roomy_plan(scene, options(3)), scene.view());
    HostClock clock;
    ours_->find_pairs(clock);
    expect_same_counts(ours_->counts(), first.counts, spec);
    EXPECT_EQ(ours_->digest(), first.digest) << spec;
  }
}

TEST_P(Thrust, StartsNoTestsOverTheCandidateLimit) {
  const Scene scene = generate("dense:n=2000");
  Plan plan = roomy_plan(scene, options());
  const FinderAnswer all = ask(*ours_, plan, scene.view());
  for (const std::uint64_t limit : {all.counts.candidates, all.counts.candidates - 1}) {
    plan.candidate_limit = limit;
    const FinderAnswer answer = ask(*ours_, plan, scene.view());
    const bool over = limit < all.counts.candidates;
    EXPECT_EQ(answer.counts.candidates, all.counts.candidates);
    EXPECT_EQ(answer.counts.over_candidate_limit, over);
    EXPECT_EQ(answer.digest, over ? PairDigest{} : all.digest);
  }
}

TEST_P(Thrust, ATangentLatticeIsCountedWhereItsUncertainPairsDoNotAllFit) {
  const Scene scene = generate("lattice:n=1000");
  Plan plan = roomy_plan(scene, options());
  const FinderAnswer all = ask(*ours_, plan, scene.view());
  for (const std::uint64_t room : {all.counts.pairs, all.counts.pairs - 1}) {
    plan.capacity.pairs = room;
    const FinderAnswer answer = ask(*ours_, plan, scene.view());
    EXPECT_EQ(answer.counts.pairs, all.counts.pairs);
    EXPECT_EQ(answer.pairs.size(), room == all.counts.pairs ? room : 0U);
  }
  plan.count_only = true;
  plan.capacity.pairs = plan.capacity.uncertain_pairs = 0;
  EXPECT_EQ(ask(*ours_, plan, scene.view()).digest, all.digest);
}

TEST_P(Thrust, SpeaksOfAViolationAsImplCpuDoes) {
  const Scene scene = generate("poly:n=1000");
  const Plan plan = roomy_plan(scene, options());
  for (const float x :
       {1e6F, std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    Scene moved = scene;
    moved.spheres[700].x = x;
    const Counts found = ask(*ours_, plan, moved.view()).counts;
    EXPECT_TRUE(found.plan_violation);
    expect_same_counts(found, ask(*cpu_, plan, moved.view()).counts, "moved");
  }
}

TEST_P(Thrust, FollowsAnUpdate) {
  const Scene before = generate("dense:n=2000,seed=1");
  Scene after = before;
  std::reverse(after.spheres.begin(), after.spheres.end());
  const Plan plan = roomy_plan(before, options());
  ask(*ours_, plan, before.view());
  ours_->update(after.view());
  HostClock clock;
  ours_->find_pairs(clock);
  EXPECT_EQ(ours_->digest(), ask(*cpu_, plan, after.view()).digest);
}

INSTANTIATE_TEST_SUITE_P(Ways, Thrust, testing::ValuesIn(kWays), [](const auto& way) {
  return std::string(name_of(way.param.method)) + "_" + std::string(name_of(way.param.rule));
});

TEST(ThrustLowestCell, IsExactForAnyCellSideAndWhereIdsWrap) {
  for (const char* spec : {"poly:n=2000", "giant:n=1000", "shifted:n=1000,offset=1e7"}) {
    const Scene scene = generate(spec);
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
    for (const double side : {0.15, 0.5, 3.0, 1e3, 1e30}) {
      const Plan plan = make_plan(measure(scene.view()), {.cell_side = side});
      const auto finder = on_thrust::make_host_backend();
      const FinderAnswer answer = ask_until_it_fits(*finder, plan, scene.view());
      EXPECT_EQ(answer.digest, truth) << spec << ", side " << side;
    }
  }
}

TEST(Scratch, PassesOnlyNewRequestsOn) {
  on_thrust::Scratch<on_thrust::HostMemory> scratch;
  for (int round = 0; round < 3; ++round) {
    char* a = scratch.allocate(1000);
    char* b = scratch.allocate(1000000);
    char* none = scratch.allocate(0);
    EXPECT_NE(a, b);
    a[999] = b[999999] = 1;
    scratch.deallocate(b, 1000000);
    EXPECT_EQ(scratch.allocate(900000), b);
    for (char* memory : {a, b, none}) scratch.deallocate(memory, 0);
  }
  EXPECT_EQ(scratch.allocations(), 3U);
  scratch.release();
  scratch.deallocate(scratch.allocate(1000), 1000);
  EXPECT_EQ(scratch.allocations(), 4U);
}

TEST(ThrustOnCuda, SaysWhyItIsNotHereOrAnswersAsTheHostDoes) {
  if (const auto reason = on_thrust::why_no_cuda()) {
    EXPECT_TRUE(*reason == "built without nvcc" || reason->starts_with("no CUDA device: "))
        << *reason;
    EXPECT_THROW(on_thrust::make_cuda_backend(), Error);
    return;
  }
  const auto device = on_thrust::make_cuda_backend();
  const auto host = on_thrust::make_host_backend();
  for (const Way& way : kWays) {
    for (const char* spec :
         {"gas:n=0", "gas:n=20000", "lattice:n=2744", "poly:n=20000", "giant:n=20000"}) {
      const Scene scene = generate(spec);
      const Plan plan = roomy_plan(scene, {.method = way.method, .rule = way.rule});
      const FinderAnswer there = ask(*device, plan, scene.view());
      const FinderAnswer here = ask(*host, plan, scene.view());
      expect_same_counts(there.counts, here.counts, spec);
      EXPECT_EQ(there.digest, here.digest) << spec;
      EXPECT_EQ(there.pairs, here.pairs) << spec;
    }
  }
}

}  // namespace
}  // namespace octocell
