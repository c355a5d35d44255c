// SPDX-License-Identifier: MIT
// Pairs of a sphere of one set with one of another, against the pairs of both together.
#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "include/octocell/octocell.hpp"

namespace octocell {
namespace {

using List = std::vector<Pair>;

List listed(std::span<const Pair> pairs) { return {pairs.begin(), pairs.end()}; }

/// The pairs of all that have one sphere on each side.
List across(const Scene& scene, std::uint32_t first_of_others) {
  List list;
  for (const Pair& pair : reference::exact_pairs(scene)) {
    if (pair.i < first_of_others && pair.j >= first_of_others) {
      list.push_back({pair.i, pair.j - first_of_others});
    }
  }
  return list;
}

TEST(TwoSets, PairsAreThoseOfBothTogetherThatAreAcross) {
  for (const char* spec :
       {"gas:n=3000", "poly:n=2000", "lattice:n=1000", "giant:n=500", "gas:n=40"}) {
    const Scene scene = generate(spec);
    const std::span<const Sphere> all = scene.spheres;
    const auto n = static_cast<std::uint32_t>(all.size());
    for (const std::uint32_t cut : {0U, 1U, n / 3, n - 1, n}) {
      const List truth = across(scene, cut);
      const auto ours = all.first(cut);
      const auto others = all.subspan(cut);
      const Pairs found = find_pairs_between(ours, others, {.threads = 2});
      EXPECT_EQ(listed({found.data(), found.size()}), truth) << spec << ", " << cut;
      EXPECT_TRUE(found.shifts().empty());
      EXPECT_EQ(count_between(ours, others), truth.size()) << spec << ", " << cut;
      Finder finder;
      EXPECT_EQ(listed(finder.find_between(ours, others)), truth);
      EXPECT_EQ(finder.find(all).size(), reference::exact_pairs(scene).size());
      EXPECT_EQ(finder.find_between(ours, others).size(), truth.size());
    }
  }
}

TEST(TwoSets, ShiftsMoveSpheresOfTheFirstSet) {
  const std::vector<Sphere> ours = {{9.5F, 5, 5, 0.5F}};
  const std::vector<Sphere> others = {{0.25F, 5, 5, 0.5F}, {9, 5, 5, 0.5F}};
  const Box box = {.vector = {{10, 0, 0}, {0, 10, 0}, {0, 0, 10}}};
  const Pairs found = find_pairs_between(ours, others, {.box = box});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], (Pair{0, 0}));
  EXPECT_EQ(found.shifts()[0], (Shift{-1, 0, 0}));  // 9.5 - 10 is near 0.25
  EXPECT_EQ(found[1], (Pair{0, 1}));
  EXPECT_EQ(found.shifts()[1], (Shift{0, 0, 0}));
}

TEST(TwoSets, ASphereMeetsAnotherInAllImages) {
  // Both signs of S, because i and j are of different sets.
  const std::vector<Sphere> one = {{0, 0, 0, 0.5F}};
  const Box box = {.vector = {{1, 0, 0}, {0, 9, 0}, {0, 0, 9}}, .periodic = {true, false, false}};
  const Pairs found = find_pairs_between(one, one, {.box = box});
  ASSERT_EQ(found.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(found[static_cast<std::size_t>(k)], (Pair{0, 0}));
    EXPECT_EQ(found.shifts()[static_cast<std::size_t>(k)], (Shift{k - 1, 0, 0}));
  }
}

TEST(TwoSets, AnInvalidSphereIsNamedInItsSet) {
  const std::vector<Sphere> good = {{0, 0, 0, 1}, {1, 0, 0, 1}};
  const std::vector<Sphere> bad = {{0, 0, 0, 1}, {1, 0, 0, -1}};
  for (const bool second : {false, true}) {
    try {
      find_pairs_between(second ? good : bad, second ? bad : good);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.sphere(), 1U);
      EXPECT_EQ(std::string(error.what()).starts_with("others: sphere 1"), second) << error.what();
    }
  }
}

TEST(TwoSets, FlagsAreRefused) {
  const std::vector<Sphere> one = {{0, 0, 0, 1}};
  const std::vector<Flags> flags(1);
  EXPECT_THROW(find_pairs_between(one, one, {.flags = flags}), Error);
  Finder finder({.flags = flags});
  EXPECT_THROW(finder.find_between(one, one), Error);
}

}  // namespace
}  // namespace octocell
