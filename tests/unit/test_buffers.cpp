// SPDX-License-Identifier: MIT
// A full buffer is an answer: the required size. Nothing is clipped, nothing is lost.
#include <gtest/gtest.h>

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell {
namespace {

class Buffers : public testing::TestWithParam<Implementation> {
 protected:
  Plan plan(const Scene& scene) const {
    return plan_scene(scene.view(), GetParam().plan_options());
  }
  std::unique_ptr<PairFinder> finder_ = GetParam().backend->create();
  HostClock clock_;
};

TEST_P(Buffers, SayHowManyPairsTheyNeed) {
  const Scene scene = generate("dense:n=2000");
  const std::uint64_t needed = reference::exact_pairs(scene.spheres).size();
  for (const std::uint64_t room : {needed, needed - 1, std::uint64_t{0}}) {
    Plan small = plan(scene);
    small.capacity.pairs = room;
    const auto finder = GetParam().backend->create();
    finder->upload(small, scene.view());
    finder->find_pairs(clock_);
    const Counts found = finder->counts();
    if (!GetParam().negative_control()) {
      EXPECT_EQ(found.pairs, needed);
    }
    EXPECT_EQ(fits(found, small.capacity, false), found.pairs <= room) << room;
  }
}

TEST_P(Buffers, GrowUntilTheAnswerIsComplete) {
  const Scene scene = generate("lattice:n=3000");
  find_completely(*finder_, scene.view(), GetParam().plan_options());
  const PairDigest complete_digest = finder_->digest();
  Plan nothing = plan(scene);
  nothing.capacity = {};
  const auto finder = GetParam().backend->create();
  const Outcome outcome = complete(*finder, scene.view(), nothing, clock_);
  EXPECT_GT(outcome.runs, 1);
  EXPECT_EQ(finder->digest(), complete_digest);
}

TEST_P(Buffers, AreNotNeededToCount) {
  for (const char* spec :
       {"dense:n=2000", "lattice:n=1000"}) {  // the lattice's pairs are uncertain pairs
    const Scene scene = generate(spec);
    const PlanOptions keep = GetParam().plan_options();
    PlanOptions count = keep;
    count.count_only = true;
    find_completely(*finder_, scene.view(), keep);
    const auto counter = GetParam().backend->create();
    const Outcome outcome = find_completely(*counter, scene.view(), count);
    EXPECT_EQ(counter->digest(), finder_->digest()) << spec;
    EXPECT_EQ(outcome.plan.capacity.pairs, 0U);
    EXPECT_EQ(outcome.plan.capacity.uncertain_pairs, 0U);
  }
}

TEST_P(Buffers, AreLeftAloneOverTheCandidateLimit) {
  const Scene scene = generate("identical:n=1000");
  PlanOptions limited = GetParam().plan_options();
  limited.candidate_limit = 1000;
  const Outcome outcome = find_completely(*finder_, scene.view(), limited);
  EXPECT_TRUE(outcome.counts.over_candidate_limit);
  EXPECT_GT(outcome.counts.candidates, 1000U);
}

std::vector<Implementation> here() {
  std::vector<Implementation> list = implementations();
  std::erase_if(
      list, [](const Implementation& how) { return how.backend->why_unavailable().has_value(); });
  return list;
}

INSTANTIATE_TEST_SUITE_P(Implementations, Buffers, testing::ValuesIn(here()), [](const auto& how) {
  std::string name = how.param.label();
  for (char& c : name) c = std::isalnum(c) ? c : '_';
  return name;
});

TEST(Update, AnswersForTheSpheresAsTheyAreNow) {
  const Scene before = generate("dense:n=3000,seed=1");
  Scene after = before;
  for (std::size_t i = 0; i < after.spheres.size(); ++i) {
    std::swap(after.spheres[i].x, after.spheres[i].y);
    after.spheres[i].z *= i % 2 == 0 ? 0.9F : 0.95F;
  }
  const PairDigest truth = digest_of(reference::exact_pairs(after.spheres));
  for (const Implementation& how : here()) {
    if (how.negative_control() || how.has_known_issues()) continue;
    const auto finder = how.backend->create();
    PlanOptions options = how.plan_options();
    find_completely(*finder, before.view(), options);
    // The scene has kept its box (x and y swapped, z shrunk), up to what stage 1 says of it.
    finder->update(after.view());
    HostClock clock;
    finder->find_pairs(clock);
    if (finder->counts().plan_violation) {
      find_completely(*finder, after.view(), options);  // planned again, as a harness would
    }
    EXPECT_EQ(finder->digest(), truth) << how.label();
  }
}

TEST(Update, MayBringMoreSpheresThanTheUpload) {
  const Scene scene = generate("dense:n=4000");
  const SceneView few = {std::span(scene.spheres).first(100)};
  const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
  for (const Implementation& how : here()) {
    if (how.negative_control() || how.has_known_issues()) continue;
    PlanOptions options = how.plan_options();
    options.moving = true;
    const auto finder = how.backend->create();
    HostClock clock;
    const Plan plan = plan_scene(scene.view(), options);
    finder->upload(plan, few);
    finder->find_pairs(clock);
    finder->update(scene.view());
    finder->find_pairs(clock);
    const bool fitted = fits(finder->counts(), plan.capacity, plan.count_only);
    EXPECT_TRUE(fitted || plan.method == Method::tiles) << how.label();
    if (!fitted) complete(*finder, scene.view(), grow(plan, finder->counts()), clock);
    EXPECT_EQ(finder->counts().plan_violation, std::nullopt) << how.label();
    EXPECT_EQ(finder->digest(), truth) << how.label();
  }
}

TEST(PlanViolation, IsReportedNotGuessed) {
  const Scene before = generate("gas:n=1000");
  Scene after = before;
  after.spheres[10].x = 1e6F;
  const auto finder = backend_named("impl_cpu").create();
  find_completely(*finder, before.view(), {});
  finder->update(after.view());
  HostClock clock;
  finder->find_pairs(clock);
  EXPECT_TRUE(finder->counts().plan_violation);
  EXPECT_THROW(complete(*finder, after.view(), make_plan(measure(before.view())), clock),
               LimitError);
}

}  // namespace
}  // namespace octocell
