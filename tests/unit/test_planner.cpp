// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/chapter32.hpp"
#include "core/error.hpp"
#include "core/planner/explain.hpp"
#include "core/planner/planner.hpp"
#include "core/planner/sampled_cells.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {
namespace {

Plan plan_for(const char* spec, const PlanOptions& options = {}) {
  return make_plan(measure(generate(spec).view()), options);
}

TEST(Planner, AnEmptySceneNeedsNothing) {
  const Plan plan = make_plan(measure({}));
  EXPECT_EQ(plan.facts.sphere_count, 0U);
  EXPECT_FALSE(to_text(explain(measure({}), plan, {})).empty());
}

TEST(Planner, Chapter32CellsAreThreeRootTwoRadiiWide) {
  const Plan plan = plan_for("gas:n=1000", {.rule = Rule::chapter32});
  EXPECT_GE(plan.grid.cell_side, 3.0 * 1.41421356237309505 * 0.5);
  EXPECT_LE(plan.grid.cell_side, 3.0 * 1.41421356237309505 * 0.5 * 1.008);
}

TEST(Planner, Chapter32IsRefusedWhereFloatsAreTooCoarse) {
  try {
    plan_for("shifted:n=1000,offset=1e7", {.rule = Rule::chapter32});
    FAIL() << "accepted";
  } catch (const LimitError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("lowest_cell"), std::string::npos);
  }
  EXPECT_NO_THROW(plan_for("shifted:n=1000,offset=1e6", {.rule = Rule::chapter32}));
}

TEST(Planner, TheFastFilterIsForRadiiInItsRange) {
  const auto test = [](std::vector<Sphere> spheres) {
    spheres[0].x = 0.1F;  // off any lattice
    const Skips allowed = Skips::all().without(Skip::equal_radii);
    return make_plan(measure({spheres}), {.allowed = allowed}).test;
  };
  EXPECT_EQ(test({{0, 0, 0, 1}, {0, 0, 0, 0}}), PairTest::filter_fast);
  EXPECT_EQ(test({{0, 0, 0, kFastRadiusMin}, {0, 0, 0, kFastRadiusMax}}), PairTest::filter_fast);
  EXPECT_EQ(test({{0, 0, 0, 1}, {0, 0, 0, 0x1p-61F}}), PairTest::filter_safe);
  EXPECT_EQ(test({{0, 0, 0, 0x1p63F}}), PairTest::filter_safe);
}

TEST(Planner, AGiantDoesNotDictateTheCellSide) {
  const Plan plan = plan_for("giant:n=20000");
  EXPECT_LT(plan.grid.cell_side, plan.facts.r_max);
}

TEST(Planner, CellsFollowTheClustersNotTheirBox) {
  // Two clouds far apart: the average density of the box is nearly zero.
  std::vector<Sphere> spheres = generate("gas:n=20000").spheres;
  for (std::size_t i = 0; i < spheres.size(); i += 2) {
    spheres[i].x += 1e6F;
    spheres[i].y += 1e6F;
    spheres[i].z += 1e6F;
  }
  const SceneStats stats = measure({spheres});
  const Plan plan = make_plan(stats);
  EXPECT_LE(plan.grid.cell_side, 20.0);
  EXPECT_TRUE(plan.grid.wraps());
}

TEST(Planner, GrowsEveryBufferToWhatWasFoundAndShrinksNone) {
  Plan plan = plan_for("gas:n=1000");
  plan.capacity = {.ids = 10, .cells = 10, .uncertain_pairs = 10, .pairs = 10};
  const Plan next =
      grow(plan, {.ids = 100, .cells = 5, .uncertain_pairs = 20, .pairs = 7, .used = {}});
  EXPECT_EQ(next.capacity.ids, 100U);
  EXPECT_GE(next.capacity.cells, 10U);
  EXPECT_EQ(next.capacity.uncertain_pairs, 20U);
  EXPECT_EQ(next.capacity.pairs, 10U);
}

TEST(Planner, RefusesCellSidesThatMakeNoSense) {
  for (const double side : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(plan_for("gas:n=10", {.cell_side = side}), InputError) << side;
  }
  EXPECT_THROW(plan_for("gas:n=10", {.rule = Rule::chapter32, .cell_side = 1.0}), InputError);
}

TEST(Planner, NamesTheFirstInvalidSphere) {
  std::vector<Sphere> spheres = generate("gas:n=100").spheres;
  spheres[42].r = -1.0F;
  spheres[77].x = std::numeric_limits<float>::infinity();
  try {
    measure({spheres});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("sphere 42"), std::string::npos) << error.what();
  }
}

PlanOptions planned(Skips allowed = Skips::all(), Skips forced = {}) {
  return {.method = {}, .allowed = allowed, .forced = forced};
}

TEST(Planner, TestsAllPairsOfFewSpheres) {
  const Plan plan = plan_for("gas:n=60", planned());
  EXPECT_EQ(plan.method, Method::brute_force);
  EXPECT_TRUE(plan.taken.has(Skip::grid));
  EXPECT_NE(plan_for("gas:n=60", planned(Skips::all().without(Skip::grid))).method,
            Method::brute_force);
}

TEST(Planner, NeedsOneIdASphereWhereRadiiAreAlike) {
  const Plan plan = plan_for("gas:n=20000", planned());
  ASSERT_EQ(plan.method, Method::half_shell);
  EXPECT_EQ(plan.levels.count, 1);
  EXPECT_GE(plan.levels.level[0].grid.cell_side, 2.0 * plan.facts.r_max);
  EXPECT_EQ(plan_for("gas:n=20000", planned(Skips::all().without(Skip::phantoms))).method,
            Method::home_phantom);
}

TEST(Planner, GivesAGiantALevelOfItsOwn) {
  const Plan plan = plan_for("giant:n=20000", planned());
  ASSERT_EQ(plan.method, Method::half_shell);
  ASSERT_EQ(plan.levels.count, 2);
  EXPECT_EQ(plan.levels.level[0].r_max, 0.5F);
  EXPECT_EQ(plan.levels.level[1].r_max, plan.facts.r_max);
  EXPECT_GE(plan.levels.level[1].first_id, plan.levels.level[0].ids);
  const Skips one_level = Skips::all().without(Skip::wide_cells);
  EXPECT_FALSE(plan_for("giant:n=20000", planned(one_level)).taken.has(Skip::wide_cells));
}

TEST(Planner, GivesPointsALevelOfTheirOwn) {
  std::vector<Sphere> spheres = generate("gas:n=20000").spheres;
  for (Sphere& s : spheres) s.r = 0.0F;
  spheres[1234].r = 20.0F;
  const SceneStats stats = measure({spheres});
  ASSERT_EQ(stats.radii.size(), 2U);
  EXPECT_EQ(stats.radii[0].count, 19999U);
  EXPECT_EQ(stats.radii[0].largest, 0.0F);
  EXPECT_EQ(stats.radii[1].radius_sum, 20.0);
  const Plan plan = make_plan(stats, planned());
  ASSERT_EQ(plan.levels.count, 2);
  EXPECT_EQ(plan.levels.level[0].r_max, 0.0F);
  EXPECT_LT(plan.levels.level[0].grid.cell_side, 20.0);
  spheres[1] = {0, 0, 0, 1e-45F};  // has the exponent of zero, and is none
  EXPECT_EQ(measure({spheres}).radii.size(), 3U);
}

TEST(Planner, SeesThatASceneIsFlat) {
  EXPECT_TRUE(plan_for("discs:n=20000", planned()).taken.has(Skip::layers));
  EXPECT_FALSE(plan_for("gas:n=20000", planned()).taken.has(Skip::layers));
  const Skips thick = Skips::all().without(Skip::layers);
  const Plan plan = plan_for("discs:n=20000", {.method = Method::half_shell, .allowed = thick});
  EXPECT_GE(plan.levels.level[0].grid.cell_count[2], 2U);
}

TEST(Planner, CellsOfEveryLevelAreADiameterWide) {
  for (const char* scene : {"gas:n=5000", "poly:n=5000,ratio=1e6", "discs:n=5000", "giant:n=5000",
                            "shifted:n=5000,offset=1e7", "chain:n=5000", "identical:n=500"}) {
    const Plan plan = plan_for(scene, {.method = Method::half_shell});
    std::uint64_t next_id = 0;
    for (int k = 0; k < plan.levels.count; ++k) {
      const Level& level = plan.levels.level[k];
      EXPECT_GE(level.grid.cell_side, 2.0 * level.r_max) << scene;
      const double unit = level.grid.cell_side / level.grid.width[1].units;
      EXPECT_GE(level.column_reach * level.grid.width[0].units * unit, 2.0 * level.r_max) << scene;
      EXPECT_EQ(level.first_id, next_id) << scene;
      next_id += level.ids;
      for (int a = 0; a < 3; ++a) {
        if (level.grid.wraps(a)) {
          EXPECT_GE(level.grid.period(a), 2 * level.column_reach + 2) << scene;
        }
      }
    }
    EXPECT_LE(next_id, std::uint64_t{1} << plan.key_bits) << scene;
    EXPECT_LE(plan.key_bits, kMaxKeyBits) << scene;
  }
}

TEST(Planner, TakesWhatIsForcedOrSaysWhyItCannot) {
  EXPECT_EQ(plan_for("gas:n=5000", planned(Skips::all(), Skips().with(Skip::grid))).method,
            Method::brute_force);
  EXPECT_EQ(plan_for("gas:n=50", planned(Skips::all(), Skips().with(Skip::phantoms))).method,
            Method::half_shell);
  const Skips levels = Skips().with(Skip::wide_cells).with(Skip::phantoms);
  EXPECT_GE(plan_for("poly:n=5000", planned(Skips::all(), levels)).levels.count, 2);
  for (const Skip skip : {Skip::wide_cells, Skip::layers}) {
    try {
      plan_for("gas:n=5000", planned(Skips::all(), Skips().with(skip)));
      ADD_FAILURE() << name_of(skip) << " was accepted";
    } catch (const LimitError& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(name_of(skip)), std::string::npos);
    }
  }
}

TEST(Planner, SortsAllBitsIfItMustNotKnowBetter) {
  const Skips allowed = Skips::all().without(Skip::key_bits);
  EXPECT_EQ(plan_for("gas:n=5000", planned(allowed)).key_bits, 32);
  EXPECT_LT(plan_for("gas:n=5000", planned()).key_bits, 32);
}

TEST(Planner, ExplainsEveryDecision) {
  const Scene scene = generate("giant:n=20000");
  const SceneStats stats = measure(scene.view());
  const Plan plan = make_plan(stats, planned());
  const Explanation why = explain(stats, plan, planned(), Skips());
  const std::string text = to_text(why);
  for (const char* word : {"20000 spheres", "half_shell", "level 1", "radix sort", "SKIPS phantoms",
                           "SKIPS wide_cells", "keeps grid", "expected"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
  }
  for (const Decision& d : why.decisions) {
    EXPECT_FALSE(d.fact.empty()) << name_of(d.skip);
    if (d.taken && (d.skip == Skip::phantoms || d.skip == Skip::wide_cells)) {
      ASSERT_TRUE(d.expected_saving.has_value());
      EXPECT_GT(*d.expected_saving, 0.0);
    }
  }
}

std::vector<Sphere> one_large_among_small() {
  std::vector<Sphere> spheres = generate("gas:n=100000").spheres;
  spheres[500].r = 30.0F;
  return spheres;
}

std::vector<std::string> warnings_for(const std::vector<Sphere>& spheres, PlanOptions options) {
  const SceneStats stats = measure({spheres});
  return explain(stats, make_plan(stats, options), options).warnings;
}

TEST(Planner, WarnsOfChoicesThatCostMuch) {
  const std::vector<Sphere> spheres = one_large_among_small();
  const auto expect_one = [](const std::vector<std::string>& warnings, const char* what,
                             const char* flag) {
    ASSERT_EQ(warnings.size(), 1U) << what;
    EXPECT_NE(warnings[0].find(what), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[0].find("half_shell"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[0].find(flag), std::string::npos) << warnings[0];
  };
  expect_one(warnings_for(spheres, {.method = Method::home_phantom, .rule = Rule::chapter32}),
             "rule chapter32 is expected", "--rule");
  expect_one(warnings_for(spheres, {.method = Method::brute_force}), "method brute_force",
             "--method");
  expect_one(warnings_for(spheres, {.method = Method::home_phantom, .cell_side = 100.0}),
             "cell side 100", "--cell-side");
  expect_one(warnings_for(spheres, {.method = Method::half_shell,
                                    .allowed = Skips::all().without(Skip::wide_cells)}),
             "this choice", "--no-skip wide_cells");
}

TEST(Planner, DoesNotWarnOfItsOwnChoicesOrOfGoodOnes) {
  const std::vector<Sphere> spheres = one_large_among_small();
  EXPECT_TRUE(warnings_for(spheres, planned()).empty());
  EXPECT_TRUE(warnings_for(spheres, planned(Skips::all().without(Skip::sort))).empty());
  EXPECT_TRUE(warnings_for(spheres, {.method = Method::half_shell}).empty());
  EXPECT_TRUE(warnings_for(generate("gas:n=60").spheres, {.rule = Rule::chapter32}).empty());
  EXPECT_TRUE(warnings_for(generate("gas:n=20000").spheres, {.rule = Rule::chapter32}).empty());
  EXPECT_TRUE(warnings_for(spheres, {.rule = Rule::as_written}).empty());
}

/// Blocks of any size, as if each pair were asked; grids of more cells than a word's Morton codes
/// tell apart, too.
TEST(SampledCells, CountThePairsInEachBlock) {
  for (const float scale : {1.0F, 1e6F}) {
    std::vector<Sphere> spheres = generate("cluster:n=300").spheres;
    for (std::size_t i = 0; i < spheres.size(); i += 2) spheres[i].x *= scale;
    const Grid grid = make_level(measure({spheres}).facts, 0.5F, 1.0, 4, 28).grid;
    const SampledCells sampled(grid, spheres, 4);
    const bool is_wide = grid.cell_count[0] / 4 >= 1U << 21;
    EXPECT_EQ(is_wide, scale > 1.0F);
    for (int shift = 0; shift <= (is_wide ? 27 : 21); shift += 3) {
      std::uint64_t pairs = 0;
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const Cell a = cell_of(grid, spheres[i].x, spheres[i].y, spheres[i].z);
          const Cell b = cell_of(grid, spheres[j].x, spheres[j].y, spheres[j].z);
          pairs += (a.x / 4) >> shift == (b.x / 4) >> shift && a.y >> shift == b.y >> shift &&
                           a.z >> shift == b.z >> shift
                       ? 1
                       : 0;
        }
      }
      EXPECT_EQ(sampled.pairs_in_blocks(shift), pairs) << scale << " " << shift;
    }
  }
}

}  // namespace
}  // namespace octocell
