// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "harness/interface/chapter32.hpp"
#include "harness/interface/error.hpp"
#include "harness/planner/planner.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {
namespace {

Plan plan_for(const char* spec, const PlanOptions& options = {}) {
  return make_plan(measure(generate(spec).view()), options);
}

TEST(Planner, AnEmptySceneNeedsNothing) {
  const Plan plan = make_plan(measure({}));
  EXPECT_EQ(plan.facts.sphere_count, 0U);
  EXPECT_FALSE(explain(plan).empty());
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

TEST(Planner, TheFastBandIsForRadiiInItsRange) {
  const auto band = [](std::vector<Sphere> spheres) { return make_plan(measure({spheres})).band; };
  EXPECT_EQ(band({{0, 0, 0, 1}, {0, 0, 0, 0}}), Band::fast);
  EXPECT_EQ(band({{0, 0, 0, kFastRadiusMin}, {0, 0, 0, kFastRadiusMax}}), Band::fast);
  EXPECT_EQ(band({{0, 0, 0, 1}, {0, 0, 0, 0x1p-61F}}), Band::safe);
  EXPECT_EQ(band({{0, 0, 0, 0x1p63F}}), Band::safe);
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
  plan.capacity = {.ids = 10, .cells = 10, .doubts = 10, .pairs = 10};
  const Plan next = grow(plan, {.ids = 100, .cells = 5, .doubts = 20, .pairs = 7});
  EXPECT_EQ(next.capacity.ids, 100U);
  EXPECT_GE(next.capacity.cells, 10U);
  EXPECT_EQ(next.capacity.doubts, 20U);
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

TEST(Planner, ExplainsTheSceneTheCellsTheSortAndThePredicate) {
  const std::string text = explain(plan_for("poly:n=1000"));
  for (const char* word : {"spheres: 1000", "lowest_cell", "cells:", "passes", "fast band"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
  }
}

}  // namespace
}  // namespace octocell
