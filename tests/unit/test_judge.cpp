// SPDX-License-Identifier: MIT
// What a list of pairs lacks, and when a common flaw may be claimed.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "harness/judge/evidence.hpp"
#include "harness/judge/judge.hpp"
#include "harness/scenes/scenes.hpp"
#include "tests/support/scene_folder.hpp"

namespace octocell::judge {
namespace {

using List = std::vector<ListedPair>;
using Pairs = std::vector<Pair>;

TEST(Differences, EachRowCountsOnce) {
  const List list = {{2, 1}, {1, 2}, {0, 1}, {3, 3}, {-1, 0}, {0, 4}, {0, 3}, {0, 3}};
  const Pairs truth = {{0, 1}, {1, 2}, {2, 3}};
  const Differences d = differences_of(list, truth, 4);
  EXPECT_EQ(d.found, (Pairs{{0, 1}, {1, 2}}));
  EXPECT_EQ(d.missed, (Pairs{{2, 3}}));
  EXPECT_EQ(d.false_pairs, (Pairs{{0, 3}}));
  EXPECT_EQ(d.duplicates, 2U);
  EXPECT_EQ(d.out_of_range, (std::vector<std::size_t>{3, 4, 5}));
  ASSERT_EQ(d.repeated.size(), 2U);
  EXPECT_EQ(d.repeated[0].times(), 2U);  // 0 3
  EXPECT_EQ(d.repeated[1].descending, 1U);
  EXPECT_EQ(d.found.size() + d.false_pairs.size() + d.duplicates + d.out_of_range.size(), d.listed);
  EXPECT_EQ(row_of(list, {1, 2}), 0U);
  EXPECT_EQ(row_of(list, {1, 2}, 1), 1U);
  EXPECT_EQ(row_of(list, {2, 3}), list.size());
}

Pairs pairs_from(std::uint32_t first, std::uint32_t count) {
  Pairs pairs;
  for (std::uint32_t k = 0; k < count; ++k) pairs.push_back({first + k, first + k + 1});
  return pairs;
}

Hypothesis above(std::uint32_t least, bool spoils_some) {
  return {.name = "above " + std::to_string(least),
          .text = "are above",
          .holds = [least](Pair pair) { return pair.i >= least; },
          .spoils_some = spoils_some};
}

TEST(Evidence, TheMostSpecificHypothesisIsClaimed) {
  const Evidence evidence = {"missed", "pairs", pairs_from(1000, 20), pairs_from(0, 500)};
  const std::vector<Hypothesis> all = {above(200, true), above(490, true), above(1001, true)};
  const auto cause = common_cause(evidence, all);
  ASSERT_TRUE(cause);
  EXPECT_EQ(cause->name, "above 490");
  EXPECT_EQ(cause->right_with, 10U);
  EXPECT_EQ(cause->wrong, 20U);
}

TEST(Evidence, RightPairsSpeakAgainstAFlawThatSpoilsAll) {
  const Evidence evidence = {"missed", "pairs", pairs_from(1000, 20), pairs_from(0, 500)};
  EXPECT_FALSE(common_cause(evidence, std::vector{above(490, false)}));
  EXPECT_TRUE(common_cause(evidence, std::vector{above(499, false)}));
  EXPECT_FALSE(common_cause(evidence, std::vector{above(200, true)})) << "more than half";
}

TEST(Evidence, FewPairsProveNothing) {
  const Evidence one = {"missed", "pairs", pairs_from(1000, 1), pairs_from(0, 500)};
  EXPECT_FALSE(common_cause(one, std::vector{above(1000, false)}));
  EXPECT_TRUE(is_too_little(one));
  const Evidence none_right = {"missed", "pairs", pairs_from(0, 500), {}};
  EXPECT_FALSE(common_cause(none_right, std::vector{above(0, true)}));
  EXPECT_TRUE(is_too_little(none_right));
  const Evidence three = {"missed", "pairs", pairs_from(1000, 3), pairs_from(0, 500)};
  EXPECT_TRUE(common_cause(three, std::vector{above(1000, false)}));
  EXPECT_FALSE(is_too_little(three));
}

TEST(Judge, AnEmptyListAndAnEmptySceneAreJudged) {
  const Scene scene = generate("gas:n=300");
  const Judgement all_lost = judge(List{}, scene);
  EXPECT_EQ(all_lost.differences.missed.size(), all_lost.true_pairs);
  EXPECT_TRUE(all_lost.causes.empty());
  EXPECT_TRUE(judge(List{}, Scene{}).exact());
  const Judgement nothing_there = judge(List{{0, 0}, {0, 1}}, Scene{});
  EXPECT_EQ(nothing_there.differences.out_of_range.size(), 2U);
}

class PairFiles : public SceneFiles {};

TEST_F(PairFiles, TextMayBeWrittenInManyWays) {
  const List expected = {{3, 1}, {-4, 500000000000}};
  for (const char* text : {"3,1\n-4,500000000000\n", "3 1\r\n-4\t500000000000",
                           "# a\n3;1;\n-4;5e11", "i j\n\n+3.0 1e0 # b\n-4.0 500000000000"}) {
    EXPECT_EQ(load_pairs(write("pairs.txt", text)), expected) << text;
  }
  EXPECT_EQ(load_pairs(write("none.txt", "")), List{});
  EXPECT_EQ(load_pairs(write("none.csv", "i,j\n")), List{});
}

TEST_F(PairFiles, NumbersThatAreNoIntegersAreRefused) {
  for (const char* text : {"1,1.5", "1,1e300", "1,nan", "1,0x3", "1,", "1,2,3", "a,b\nc,d"})
    EXPECT_THROW(load_pairs(write("pairs.txt", text)), InputError) << text;
}

}  // namespace
}  // namespace octocell::judge
