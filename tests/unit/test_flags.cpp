// SPDX-License-Identifier: MIT
// Static spheres, groups and masks: the definition, and every implementation compared with it.
#include <gtest/gtest.h>

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/flags.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell {
namespace {

using Words = std::vector<Flags>;

/// docs/architecture.md, word by word.
bool by_definition(bool static_a, unsigned group_a, unsigned mask_a, bool static_b,
                   unsigned group_b, unsigned mask_b) {
  if (static_a && static_b) return false;
  return (group_a & mask_b) != 0 && (group_b & mask_a) != 0;
}

TEST(MayCollide, IsTheDefinitionForAllSmallGroupsAndMasks) {
  for (unsigned bits = 0; bits < 1U << 14; ++bits) {
    const bool static_a = (bits & 1U) != 0;
    const bool static_b = (bits & 2U) != 0;
    const unsigned group_a = bits >> 2 & 7U;
    const unsigned mask_a = bits >> 5 & 7U;
    const unsigned group_b = bits >> 8 & 7U;
    const unsigned mask_b = bits >> 11 & 7U;
    const Flags a = make_flags(static_a, group_a, mask_a);
    const Flags b = make_flags(static_b, group_b, mask_b);
    const bool expected = by_definition(static_a, group_a, mask_a, static_b, group_b, mask_b);
    ASSERT_EQ(may_collide(a, b), expected) << bits;
    ASSERT_EQ(may_collide(b, a), expected) << bits;
    ASSERT_EQ(reference::allowed(a, b), expected) << bits;
  }
}

TEST(MayCollide, TellsEachOfFifteenGroupsApart) {
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j < 16; ++j) {
      const Flags seeks = make_flags(false, kMaxGroup, 1U << j);
      const Flags is = make_flags(false, 1U << i, kMaxMask);
      EXPECT_EQ(may_collide(seeks, is), i == j);
      EXPECT_EQ(reference::allowed(seeks, is), i == j);
    }
  }
}

TEST(MayCollide, AgreesWithTheReferenceOnAnyWords) {
  std::mt19937 random(1);
  int collide = 0;
  for (int k = 0; k < 20000; ++k) {
    // Sparse words, so that both answers are common.
    const auto word = [&] { return static_cast<std::uint32_t>(random() & random() & random()); };
    const Flags a = {word()};
    const Flags b = {word()};
    ASSERT_EQ(may_collide(a, b), reference::allowed(a, b)) << a.word << ' ' << b.word;
    collide += may_collide(a, b) ? 1 : 0;
  }
  EXPECT_GT(collide, 500);
  EXPECT_LT(collide, 19500);
}

TEST(Flags, AreAWordThatHoldsAllThree) {
  const Flags f = make_flags(true, 0x1234, 0xabcd);
  EXPECT_EQ(f.word, 0xabcd9234U);
  EXPECT_TRUE(is_static(f));
  EXPECT_EQ(group_of(f), 0x1234U);
  EXPECT_EQ(mask_of(f), 0xabcdU);
  EXPECT_EQ(Flags{}, make_flags(false, 1, kMaxMask));
}

TEST(SomeMayCollide, IsNeverFalseWhereAPairMay) {
  std::mt19937 random(2);
  int none = 0;
  for (int round = 0; round < 20000; ++round) {
    Words flags(2 + random() % 3);
    for (Flags& f : flags) {
      f.word = static_cast<std::uint32_t>(random() & random() & random()) & 0x000f800fU;
    }
    bool some = false;
    for (std::size_t i = 0; i < flags.size(); ++i) {
      for (std::size_t j = i + 1; j < flags.size(); ++j) some |= may_collide(flags[i], flags[j]);
    }
    ASSERT_TRUE(some_may_collide(flags) || !some);
    none += some_may_collide(flags) ? 0 : 1;
  }
  EXPECT_GT(none, 100);
}

TEST(SomeMayCollide, SeesThatStaticWorldsAndStrangersDoNot) {
  EXPECT_TRUE(some_may_collide({}));
  EXPECT_TRUE(some_may_collide(Words(3)));
  EXPECT_FALSE(some_may_collide(Words(3, make_flags(true, 1, kMaxMask))));
  EXPECT_FALSE(some_may_collide(Words(3, make_flags(false, 4, kMaxMask & ~4U))));
  EXPECT_FALSE(some_may_collide(Words{make_flags(false, 1, 2), make_flags(true, 1, 1)}));
  EXPECT_TRUE(some_may_collide(Words{make_flags(false, 1, 2), make_flags(true, 2, 1)}));
}

/// Any words: every group and mask, about half of the spheres static.
Words random_flags(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Words flags(count);
  for (Flags& f : flags) f.word = static_cast<std::uint32_t>(random() & random());
  return flags;
}

TEST(ReferenceWithFlags, BothMethodsAgreeAndDropWhatIsNotAllowed) {
  for (const char* spec : {"dense:n=2000", "lattice:n=2000", "identical:n=300", "giant:n=2000"}) {
    const std::vector<Sphere> spheres = generate(spec).spheres;
    const Words flags = random_flags(spheres.size(), 3);
    std::vector<Pair> expected = reference::brute_force(spheres);
    const std::size_t before = expected.size();
    std::erase_if(expected, [&](Pair p) {
      const Flags a = flags[p.i];
      const Flags b = flags[p.j];
      return !by_definition(is_static(a), group_of(a), mask_of(a), is_static(b), group_of(b),
                            mask_of(b));
    });
    EXPECT_LT(expected.size(), before) << spec;
    EXPECT_GT(expected.size(), 0U) << spec;
    EXPECT_EQ(reference::brute_force(spheres, flags), expected) << spec;
    EXPECT_EQ(reference::box_tree(spheres, flags), expected) << spec;
  }
}

/// The answer of one implementation; none if its rule refuses the scene.
std::optional<std::vector<Pair>> answer(const Implementation& how, SceneView scene) {
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  try {
    find_completely(*finder, scene, how.plan_options(2));
  } catch (const LimitError& refusal) {
    EXPECT_EQ(how.rule, Rule::chapter32) << refusal.what();
    return std::nullopt;
  }
  const std::vector<Pair> pairs = finder->download();
  EXPECT_EQ(finder->digest(), digest_of(pairs));
  return pairs;
}

class WithFlags : public testing::TestWithParam<Implementation> {
 protected:
  void expect_exact(SceneView scene, const std::string& what) {
    const auto pairs = answer(GetParam(), scene);
    if (!pairs) return;
    const auto truth = reference::exact_pairs(scene.spheres, scene.flags);
    const reference::Comparison difference = reference::compare(*pairs, truth);
    const bool may_lose = GetParam().has_known_issues();
    EXPECT_TRUE(difference.missed == 0 || may_lose) << what << ": missed " << difference.missed;
    EXPECT_EQ(difference.false_pairs, 0U) << what;
    EXPECT_EQ(difference.duplicates, 0U) << what;
  }
};

TEST_P(WithFlags, EveryGeneratorIsExact) {
  for (const SceneInfo& info : scenes()) {
    for (const char* n : {"2", "33", "1500"}) {
      const std::string spec = std::string(info.name) + ":n=" + n;
      const std::vector<Sphere> spheres = generate(spec).spheres;
      const Words flags = random_flags(spheres.size(), 4);
      expect_exact({spheres, flags}, spec);
      const Scene with_statics = generate(spec + ",static=0.9,groups=3");
      expect_exact(with_statics.view(), with_statics.spec);
    }
  }
}

TEST_P(WithFlags, AStaticWorldHasNoPairs) {
  const std::vector<Sphere> spheres = generate("dense:n=800").spheres;
  const Words flags(spheres.size(), make_flags(true, 1, kMaxMask));
  const auto pairs = answer(GetParam(), {spheres, flags});
  ASSERT_TRUE(pairs);
  EXPECT_TRUE(pairs->empty());
}

TEST_P(WithFlags, FlagsThatForbidNothingChangeNothing) {
  const std::vector<Sphere> spheres = generate("poly:n=1200").spheres;
  const Words flags(spheres.size());
  const auto without = answer(GetParam(), {spheres});
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->empty());
  EXPECT_EQ(answer(GetParam(), {spheres, flags}), without);
}

TEST_P(WithFlags, GroupsAndMasksMayChangePlaces) {
  const std::vector<Sphere> spheres = generate("dense:n=1200").spheres;
  Words flags = random_flags(spheres.size(), 5);
  Words swapped = flags;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    flags[i].word &= 0x7fffffffU;  // a mask that can be a group
    swapped[i] = make_flags(is_static(flags[i]), mask_of(flags[i]), group_of(flags[i]));
  }
  const auto pairs = answer(GetParam(), {spheres, flags});
  ASSERT_TRUE(pairs);
  EXPECT_FALSE(pairs->empty());
  EXPECT_EQ(answer(GetParam(), {spheres, swapped}), pairs);
}

TEST_P(WithFlags, PairsThatAreOnlyCountedAreTheSame) {
  const Implementation& how = GetParam();
  // All contacts of a lattice are uncertain pairs, which a count_only plan decides where it finds
  // them.
  const Scene scene = generate("lattice:n=1000,static=0.5,groups=3");
  const PairDigest truth = digest_of(reference::exact_pairs(scene));
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  PlanOptions options = how.plan_options(2);
  options.count_only = true;
  find_completely(*finder, scene.view(), options);
  if (how.has_known_issues()) {
    EXPECT_LE(finder->digest().count, truth.count);
  } else {
    EXPECT_EQ(finder->digest(), truth);
  }
}

TEST_P(WithFlags, AnUpdateBringsItsOwnFlags) {
  const Implementation& how = GetParam();
  const std::vector<Sphere> spheres = generate("gas:n=700").spheres;
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  const Words first = random_flags(spheres.size(), 6);
  const Words second = random_flags(spheres.size(), 7);
  find_completely(*finder, {spheres, first}, how.plan_options(2));
  HostClock clock;
  for (const std::span<const Flags> now :
       {std::span(second), std::span<const Flags>(), std::span(first)}) {
    finder->update({spheres, now});
    finder->find_pairs(clock);
    EXPECT_EQ(finder->download(), reference::exact_pairs(spheres, now)) << now.size();
  }
}

TEST_P(WithFlags, FlagsOfSomeSpheresOnlyAreRefused) {
  const std::vector<Sphere> spheres = generate("gas:n=20").spheres;
  const Words flags(19);
  const std::unique_ptr<PairFinder> finder = GetParam().backend->create();
  EXPECT_THROW(find_completely(*finder, {spheres, flags}, GetParam().plan_options(1)), InputError);
}

std::vector<Implementation> correct_implementations() {
  std::vector<Implementation> correct;
  for (const Implementation& how : implementations()) {
    if (!how.negative_control() && !how.backend->why_unavailable()) correct.push_back(how);
  }
  return correct;
}

std::string test_name(const testing::TestParamInfo<Implementation>& how) {
  std::string name = how.param.label();
  for (char& c : name) c = std::isalnum(c) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, WithFlags, testing::ValuesIn(correct_implementations()), test_name);

/// The skip `search`: where no two spheres may collide, nothing is looked for.
class NothingToFind : public testing::TestWithParam<Implementation> {
 protected:
  Plan plan_for(SceneView scene, Skips allowed = Skips::all()) {
    PlanOptions options = GetParam().plan_options(2);
    options.allowed = allowed;
    return plan_scene(scene, options);
  }
  const std::vector<Sphere> spheres_ = generate("dense:n=900").spheres;
  const Words all_static_ = Words(spheres_.size(), make_flags(true, 1, kMaxMask));
  HostClock clock_;
};

TEST_P(NothingToFind, IsFoundWithoutACandidate) {
  const std::unique_ptr<PairFinder> finder = GetParam().backend->create();
  // Something is there to be left over: lists of a run that found pairs.
  complete(*finder, {spheres_}, plan_for({spheres_}), clock_);
  EXPECT_FALSE(finder->download().empty());
  const SceneView scene = {spheres_, all_static_};
  const Plan plan = plan_for(scene);
  EXPECT_TRUE(plan.nothing_to_find);
  const Outcome outcome = complete(*finder, scene, plan, clock_);
  EXPECT_EQ(outcome.counts.candidates, 0U);
  EXPECT_EQ(outcome.counts.pairs, 0U);
  EXPECT_EQ(finder->digest(), PairDigest{});
  EXPECT_TRUE(finder->download().empty());
}

TEST_P(NothingToFind, IsLookedForWhereTheSkipIsForbidden) {
  const std::unique_ptr<PairFinder> finder = GetParam().backend->create();
  const SceneView scene = {spheres_, all_static_};
  const Plan plan = plan_for(scene, Skips::all().without(Skip::search));
  EXPECT_FALSE(plan.nothing_to_find);
  const Outcome outcome = complete(*finder, scene, plan, clock_);
  EXPECT_GT(outcome.counts.candidates, 0U);
  EXPECT_TRUE(finder->download().empty());
}

TEST_P(NothingToFind, IsNotBelievedOfOtherFlags) {
  const std::unique_ptr<PairFinder> finder = GetParam().backend->create();
  complete(*finder, {spheres_, all_static_}, plan_for({spheres_, all_static_}), clock_);
  Words one_moves = all_static_;
  one_moves[7] = Flags{};
  for (const std::span<const Flags> now : {std::span<const Flags>(one_moves), {}}) {
    finder->update({spheres_, now});
    finder->find_pairs(clock_);
    EXPECT_EQ(finder->counts().plan_violation, kFlagsBroken);
  }
}

TEST_P(NothingToFind, HoldsForAnEmptySceneThatFollows) {
  const std::unique_ptr<PairFinder> finder = GetParam().backend->create();
  complete(*finder, {spheres_}, plan_for({spheres_}), clock_);
  find_completely(*finder, {}, GetParam().plan_options(2));
  EXPECT_TRUE(finder->download().empty());
}

std::vector<Implementation> our_implementations() {
  std::vector<Implementation> ours = correct_implementations();
  std::erase_if(ours, [](const Implementation& how) { return how.is_baseline(); });
  return ours;
}

INSTANTIATE_TEST_SUITE_P(Ours, NothingToFind, testing::ValuesIn(our_implementations()), test_name);

}  // namespace
}  // namespace octocell
