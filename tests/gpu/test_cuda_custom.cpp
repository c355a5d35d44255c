// SPDX-License-Identifier: MIT
// Compares impl_cuda_custom with the exact pairs, and with impl_cpu in what each stage counts
// (half_shell numbers its cells differently, so only in what it finds). Needs a CUDA device;
// without one every test says why it was skipped.
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

#include "core/cuda/device_memory.hpp"
#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cpu/backend.hpp"
#include "impl_cuda_custom/backend.hpp"
#include "tests/support/ways.hpp"

namespace octocell {
namespace {

std::string name_of_way(const testing::TestParamInfo<Way>& info) {
  const Way& way = info.param;
  return std::string(way.method == Method::home_phantom ? name_of(way.rule) : name_of(way.method));
}

class OnDevice : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto reason = cuda_custom::why_unavailable()) GTEST_SKIP() << *reason;
    finder_ = cuda_custom::make_backend();
  }
  std::unique_ptr<PairFinder> finder_;
};

class CudaCustom : public OnDevice, public testing::WithParamInterface<Way> {
 protected:
  static PlanOptions options() { return {.method = GetParam().method, .rule = GetParam().rule}; }

  /// Nothing where rule chapter32 refuses the scene.
  static std::optional<Plan> roomy_plan(const Scene& scene) {
    const std::uint64_t n = scene.spheres.size();
    try {
      Plan plan = make_plan(measure(scene.view()), options());
      plan.capacity.ids = plan.capacity.ids * 2 + 4096;
      plan.capacity.cells = plan.capacity.ids;
      plan.capacity.pairs = 40 * n + 64 + (n <= 2000 ? n * n / 2 : 0);
      plan.capacity.uncertain_pairs = plan.capacity.pairs;
      return plan;
    } catch (const LimitError&) {
      return std::nullopt;
    }
  }

  /// The host's home_phantom, by the exact rule, says what half_shell must find.
  void expect_the_pairs_of_impl_cpu(const Scene& scene) {
    const Plan plan = roomy_plan(scene).value();
    const auto cpu = cpu::make_backend();
    find_completely(*cpu, scene.view(), {});
    HostClock clock;
    finder_->upload(plan, scene.view());
    finder_->find_pairs(clock);
    const Counts counts = finder_->counts();
    EXPECT_EQ(counts.ids, scene.spheres.size()) << scene.spec;
    EXPECT_LE(counts.cells, scene.spheres.size()) << scene.spec;
    EXPECT_GE(counts.candidates, counts.pairs) << scene.spec;
    EXPECT_EQ(counts.plan_violation, std::nullopt) << scene.spec;
    EXPECT_EQ(finder_->digest(), cpu->digest()) << scene.spec;
    EXPECT_EQ(finder_->download(), cpu->download()) << scene.spec;
  }

  void expect_what_impl_cpu_finds(const Scene& scene) {
    if (GetParam().method == Method::half_shell) return expect_the_pairs_of_impl_cpu(scene);
    const std::optional<Plan> plan = roomy_plan(scene);
    if (!plan) return;
    const auto cpu = cpu::make_backend();
    HostClock clock;
    for (PairFinder* finder : {finder_.get(), cpu.get()}) {
      finder->upload(*plan, scene.view());
      finder->find_pairs(clock);
    }
    const Counts ours = finder_->counts();
    const Counts theirs = cpu->counts();
    EXPECT_EQ(ours.ids, theirs.ids) << scene.spec;
    EXPECT_EQ(ours.cells, theirs.cells) << scene.spec;
    EXPECT_EQ(ours.candidates, theirs.candidates) << scene.spec;
    EXPECT_EQ(ours.uncertain_pairs, theirs.uncertain_pairs) << scene.spec;
    EXPECT_EQ(ours.pairs, theirs.pairs) << scene.spec;
    EXPECT_EQ(ours.plan_violation, theirs.plan_violation) << scene.spec;
    EXPECT_EQ(finder_->digest(), cpu->digest()) << scene.spec;
    EXPECT_EQ(finder_->download(), cpu->download()) << scene.spec;
  }
};

TEST_P(CudaCustom, CountsAndFindsWhatImplCpuDoes) {
  for (const SceneInfo& info : scenes()) {
    for (const char* n : {"0", "1", "2", "31", "32", "33", "255", "256", "257", "1025", "1999"}) {
      expect_what_impl_cpu_finds(generate(std::string(info.name) + ":n=" + n));
    }
  }
}

TEST_P(CudaCustom, CountsAndFindsWhatImplCpuDoesInLargeScenes) {
  for (const char* scene : {"gas", "dense", "poly", "cluster", "lattice", "shifted", "giant"}) {
    const char* const n = GetParam().method == Method::brute_force ? "20001" : "100000";
    expect_what_impl_cpu_finds(generate(std::string(scene) + ":n=" + n));
  }
}

TEST_P(CudaCustom, GrowsFromNothing) {
  for (const char* spec : {"dense:n=3000", "lattice:n=3000", "giant:n=3000"}) {
    const Scene scene = generate(spec);
    find_completely(*finder_, scene.view(), options());
    const PairDigest whole = finder_->digest();
    Plan nothing = make_plan(measure(scene.view()), options());
    nothing.capacity = {};
    HostClock clock;
    EXPECT_GT(complete(*finder_, scene.view(), nothing, clock).runs, 1) << spec;
    EXPECT_EQ(finder_->digest(), whole) << spec;
  }
}

TEST_P(CudaCustom, CountsWithoutStoring) {
  for (const char* spec : {"dense:n=3000", "lattice:n=4096", "identical:n=1500"}) {
    const Scene scene = generate(spec);
    find_completely(*finder_, scene.view(), options());
    const PairDigest stored = finder_->digest();
    PlanOptions count = options();
    count.count_only = true;
    const Outcome outcome = find_completely(*finder_, scene.view(), count);
    EXPECT_EQ(finder_->digest(), stored) << spec;
    EXPECT_EQ(outcome.plan.capacity.pairs, 0U) << spec;
  }
}

TEST_P(CudaCustom, StopsAtTheCandidateLimit) {
  PlanOptions limited = options();
  limited.candidate_limit = 1000;
  const Outcome outcome = find_completely(*finder_, generate("identical:n=1000").view(), limited);
  EXPECT_TRUE(outcome.counts.over_candidate_limit);
  EXPECT_GT(outcome.counts.candidates, 1000U);
  EXPECT_EQ(outcome.counts.pairs, 0U);
}

TEST_P(CudaCustom, FindsTheSameSetAHundredTimes) {
  const Scene scene = generate("cluster:n=20000");
  find_completely(*finder_, scene.view(), options());
  const PairDigest first = finder_->digest();
  HostClock clock;
  for (int time = 0; time < 100; ++time) {
    finder_->find_pairs(clock);
    ASSERT_EQ(finder_->digest(), first) << "time " << time;
  }
}

TEST_P(CudaCustom, AnswersTheSameAsAGraphAndWithTransfers) {
  const Scene scene = generate("poly:n=20000");
  find_completely(*finder_, scene.view(), options());
  const PairDigest first = finder_->digest();
  DeviceRuns& runs = *finder_->device_runs();
  for (int time = 0; time < 3; ++time) {
    EXPECT_GT(runs.replay_ms(), 0.0);
    EXPECT_EQ(finder_->digest(), first);
    EXPECT_GT(runs.transfers_ms(), 0.0);
    EXPECT_EQ(finder_->digest(), first);
    runs.flush_cache();
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, CudaCustom, testing::ValuesIn(kWays), name_of_way);

TEST_F(OnDevice, IdenticalSpheresInOneCellAreAllPaired) {
  const Scene scene = generate("identical:n=65536");
  find_completely(*finder_, scene.view(), {.count_only = true});
  EXPECT_EQ(finder_->digest().count, 2'147'450'880U);
}

TEST_F(OnDevice, AnyCellSideIsExact) {
  for (const char* spec : {"poly:n=2000", "giant:n=1000", "shifted:n=1000,offset=3e6"}) {
    const Scene scene = generate(spec);
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
    for (const double side : {0.15, 0.5, 1.0, 3.0, 1e3, 1e30}) {
      find_completely(*finder_, scene.view(), {.cell_side = side});
      EXPECT_EQ(finder_->digest(), truth) << spec << ", side " << side;
    }
  }
}

TEST_F(OnDevice, UpdateAnswersForTheSpheresAsTheyAreNow) {
  Scene scene = generate("dense:n=5000");
  find_completely(*finder_, scene.view(), {});
  std::reverse(scene.spheres.begin(), scene.spheres.end());
  finder_->update(scene.view());
  HostClock clock;
  finder_->find_pairs(clock);
  EXPECT_EQ(finder_->counts().plan_violation, std::nullopt);
  EXPECT_EQ(finder_->digest(), digest_of(reference::exact_pairs(scene.spheres)));
}

TEST_F(OnDevice, AReplayedGraphGoesByTheFlagsOfTheLastUpdate) {
  const Scene scene = generate("dense:n=5000,static=0.5,groups=3");
  const Scene other = generate("dense:n=5000,static=0.9");
  find_completely(*finder_, {scene.spheres}, {.method = Method::half_shell});
  DeviceRuns& runs = *finder_->device_runs();
  HostClock clock;
  for (const std::vector<Flags>& flags : {scene.flags, other.flags, {}, scene.flags}) {
    finder_->update({scene.spheres, flags});
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres, flags));
    finder_->find_pairs(clock);
    EXPECT_EQ(finder_->digest(), truth);
    runs.replay_ms();
    EXPECT_EQ(finder_->digest(), truth);
    runs.transfers_ms();
    EXPECT_EQ(finder_->digest(), truth);
  }
}

class Violations : public OnDevice, public testing::WithParamInterface<Method> {};

std::string name_of_method(const testing::TestParamInfo<Method>& info) {
  return std::string(name_of(info.param));
}

TEST_P(Violations, AreReported) {
  const Scene scene = generate("gas:n=3000");
  find_completely(*finder_, scene.view(), {.method = GetParam()});
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
  EXPECT_NE(violation_after({1e6F, 0, 0, 0.1F}).find("have left the box"), std::string::npos);
  EXPECT_NE(violation_after({0, 0, 0, 1e3F}).find("range of radii"), std::string::npos);
  EXPECT_NE(violation_after({0, 0, 0, -1.0F}).find("sphere 2000:"), std::string::npos);
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(violation_after({0, not_a_number, 0, 1}).find("sphere 2000:"), std::string::npos);
  EXPECT_EQ(violation_after(scene.spheres[2000]), "nothing");
}

INSTANTIATE_TEST_SUITE_P(Methods, Violations,
                         testing::Values(Method::home_phantom, Method::half_shell), name_of_method);

TEST_F(OnDevice, StageTimesAddUpToTheTotal) {
  const Scene scene = generate("gas:n=50000");
  const Outcome outcome = find_completely(*finder_, scene.view(), {});
  double sum = 0.0;
  for (std::size_t s = 0; s <= index_of(Stage::resolve); ++s) {
    ASSERT_TRUE(outcome.times.stage_ms[s]) << kStageNames[s];
    sum += *outcome.times.stage_ms[s];
  }
  EXPECT_GT(sum, 0.0);
  EXPECT_LE(sum, outcome.times.total_ms * 1.01);
}

TEST_F(OnDevice, TooLargeASceneIsRefusedWithTheMemoryItNeeds) {
  const Scene scene = generate("gas:n=1000");
  Plan plan = make_plan(measure(scene.view()));
  plan.capacity.pairs = std::uint64_t{1} << 50;
  const std::uint64_t held = DeviceMemory::in_use();
  try {
    finder_->upload(plan, scene.view());
    FAIL() << "accepted";
  } catch (const LimitError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("MiB are free"), std::string::npos)
        << refusal.what();
  }
  EXPECT_EQ(DeviceMemory::in_use(), held);
}

}  // namespace
}  // namespace octocell
