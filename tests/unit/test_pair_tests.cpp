// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/support/cpu_pipeline.hpp"
#include "tests/support/ways.hpp"

namespace octocell::cpu {
namespace {

std::unique_ptr<Workspace> after_pair_tests(const Scene& scene, const PlanOptions& options) {
  auto w = workspace_for(scene.view(), options);
  const std::uint64_t all_pairs = scene.spheres.size() * (scene.spheres.size() - 1) / 2;
  w->uncertain_pairs.allocate(all_pairs);
  w->pairs.allocate(all_pairs);
  bounds(*w);
  if (w->plan.method == Method::home_phantom) {
    cell_ids(*w);
    sort(*w);
    cell_index(*w);
  }
  pair_tests(*w);
  EXPECT_FALSE(w->violation) << w->violation.value_or("");
  return w;
}

std::vector<Pair> sorted(std::span<const Pair> pairs) {
  std::vector<Pair> list(pairs.begin(), pairs.end());
  std::sort(list.begin(), list.end());
  return list;
}

class PairTests : public testing::TestWithParam<Way> {
 protected:
  static PlanOptions options(int threads = 1) {
    return {.method = GetParam().method, .rule = GetParam().rule, .threads = threads};
  }
};

TEST_P(PairTests, SurePairsAreRightAndWhatIsLeftIsUncertain) {
  for (const char* spec : {"gas:n=2", "gas:n=3000", "dense:n=3000", "poly:n=3000", "lattice:n=3000",
                           "identical:n=2500", "giant:n=3000"}) {
    const Scene scene = generate(spec);
    const std::vector<Pair> truth = reference::exact_pairs(scene.spheres);
    for (const int threads : {1, 3}) {
      const auto w = after_pair_tests(scene, options(threads));
      const std::vector<Pair> sure = sorted(w->pairs.items());
      const std::vector<Pair> uncertain_pairs = sorted(w->uncertain_pairs.items());
      ASSERT_TRUE(std::includes(truth.begin(), truth.end(), sure.begin(), sure.end())) << spec;
      std::vector<Pair> both;
      std::merge(sure.begin(), sure.end(), uncertain_pairs.begin(), uncertain_pairs.end(),
                 std::back_inserter(both));
      ASSERT_EQ(std::adjacent_find(both.begin(), both.end()), both.end()) << spec << ": twice";
      ASSERT_TRUE(std::includes(both.begin(), both.end(), truth.begin(), truth.end()))
          << spec << ": lost";
    }
  }
}

TEST_P(PairTests, TangentSpheresAreUncertainAndOverlappingOnesAreNot) {
  PlanOptions uncertain = options();
  uncertain.allowed = uncertain.allowed.without(Skip::uncertain_pairs);
  const auto lattice = after_pair_tests(generate("lattice:n=1000"), uncertain);
  EXPECT_EQ(lattice->uncertain_pairs.size(), 2700U);
  EXPECT_EQ(lattice->pairs.size(), 0U);
  const auto gas = after_pair_tests(generate("gas:n=3000"), options());
  EXPECT_EQ(gas->uncertain_pairs.size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Ways, PairTests,
                         testing::Values(Way{Method::home_phantom, Rule::lowest_cell},
                                         Way{Method::home_phantom, Rule::chapter32},
                                         Way{Method::brute_force, Rule::lowest_cell}),
                         [](const auto& way) {
                           return std::string(name_of(way.param.method)) + "_" +
                                  std::string(name_of(way.param.rule));
                         });

TEST(PairTests, TilesOfAllSizesMeetEachOther) {
  for (const int n : {1023, 1024, 1025, 2047, 2048, 2049, 3001}) {
    const Scene scene = generate("identical:n=" + std::to_string(n));
    const auto expected = static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(n - 1) / 2;
    for (const Method method : {Method::home_phantom, Method::brute_force}) {
      const auto w = after_pair_tests(scene, {.method = method, .threads = 2, .count_only = true});
      EXPECT_EQ(w->pairs.size(), expected) << n;
    }
  }
}

TEST(PairTests, AsWrittenLosesTheSamePairsEveryTime) {
  const Scene scene = generate("gas:n=5000");
  const auto once = after_pair_tests(scene, {.rule = Rule::as_written, .threads = 1});
  const auto again = after_pair_tests(scene, {.rule = Rule::as_written, .threads = 3});
  const std::vector<Pair> pairs = sorted(once->pairs.items());
  EXPECT_EQ(pairs, sorted(again->pairs.items()));
  const reference::Comparison difference =
      reference::compare(pairs, reference::exact_pairs(scene.spheres));
  EXPECT_GT(difference.missed, pairs.size() / 10) << "the negative control shows nothing";
  EXPECT_EQ(difference.false_pairs, 0U);
}

/// The smallest scenes on which the text's rules lose a pair (course/lost_pairs.md).
TEST(PairTests, AsWrittenLosesTheCounterExamples) {
  const std::vector<Sphere> in_line = {{1.0F, 1, 1, 1}, {2.8F, 1, 1, 1}};
  ASSERT_TRUE(reference::overlap(in_line[0], in_line[1]));
  Scene scene;
  scene.spheres = in_line;
  EXPECT_EQ(after_pair_tests(scene, {.rule = Rule::lowest_cell})->pairs.size(), 1U);
  EXPECT_EQ(after_pair_tests(scene, {.rule = Rule::chapter32})->pairs.size(), 1U);
  EXPECT_EQ(after_pair_tests(scene, {.rule = Rule::as_written})->pairs.size(), 0U);
}

TEST(PairTests, NothingIsTestedOverTheCandidateLimit) {
  const Scene scene = generate("identical:n=2000");
  const auto w = after_pair_tests(scene, {.candidate_limit = 1000});
  EXPECT_EQ(w->candidates, 1999000U);
  EXPECT_EQ(w->pairs.size() + w->uncertain_pairs.size(), 0U);
}

}  // namespace
}  // namespace octocell::cpu
