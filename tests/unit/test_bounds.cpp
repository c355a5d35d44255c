// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "tests/support/cpu_pipeline.hpp"

namespace octocell::cpu {
namespace {

TEST(Bounds, AcceptsTheSceneThatWasPlanned) {
  for (const char* spec : {"gas:n=0", "gas:n=1", "gas:n=2", "poly:n=100001", "giant:n=65537"}) {
    const Scene scene = generate(spec);
    const auto w = workspace_for(scene.view(), {.threads = 2});
    bounds(*w);
    EXPECT_FALSE(w->violation) << spec << ": " << w->violation.value_or("");
  }
}

class BoundsOfAChangedScene : public testing::Test {
 protected:
  std::optional<std::string> violation_after(std::size_t i, Sphere changed) {
    const auto w = workspace_for(scene_.view(), {.threads = 2});
    std::vector<Sphere> spheres = scene_.spheres;
    spheres[i] = changed;
    w->scene = {spheres};
    bounds(*w);
    return w->violation;
  }
  Scene scene_ = generate("poly:n=70000,seed=3");
};

TEST_F(BoundsOfAChangedScene, SeesASphereThatLeftTheBox) {
  Sphere s = scene_.spheres[69999];
  s.y = 1e6F;
  EXPECT_TRUE(violation_after(69999, s));
}

TEST_F(BoundsOfAChangedScene, SeesALargerRadius) {
  Sphere s = scene_.spheres[5];
  s.r = 10.0F;
  EXPECT_TRUE(violation_after(5, s));
}

TEST_F(BoundsOfAChangedScene, SeesASmallerRadiusButNotZero) {
  Sphere s = scene_.spheres[5];
  s.r = 1e-30F;
  EXPECT_TRUE(violation_after(5, s));
  s.r = 0.0F;  // zero needs no lower bound: both filters handle it
  EXPECT_FALSE(violation_after(5, s));
}

TEST_F(BoundsOfAChangedScene, NamesTheSphereThatIsNotFinite) {
  Sphere s = scene_.spheres[66000];
  s.z = std::numeric_limits<float>::quiet_NaN();
  const auto violation = violation_after(66000, s);
  ASSERT_TRUE(violation);
  EXPECT_NE(violation->find("66000"), std::string::npos) << *violation;
  s.z = -std::numeric_limits<float>::infinity();
  EXPECT_TRUE(violation_after(66000, s));
  s.z = 0.0F;
  s.r = -0.5F;
  EXPECT_TRUE(violation_after(66000, s));
}

TEST(Bounds, TheFactsAreTheExtremes) {
  const std::vector<Sphere> spheres = {{1, -2, 3, 0}, {-4, 5, 6, 2}, {0, 0, 9, 0.5F}};
  const FactsPass pass = measure_facts(spheres);
  EXPECT_TRUE(pass.valid);
  EXPECT_EQ(pass.facts.lowest[0], -4.0F);
  EXPECT_EQ(pass.facts.lowest[1], -2.0F);
  EXPECT_EQ(pass.facts.highest[2], 9.0F);
  EXPECT_EQ(pass.facts.r_max, 2.0F);
  EXPECT_EQ(pass.facts.r_min_nonzero, 0.5F);
}

TEST(Bounds, TheFactsOfPartsAreTheFactsOfTheWhole) {
  const Scene scene = generate("poly:n=1000");
  const std::span<const Sphere> all = scene.spheres;
  const FactsPass whole = measure_facts(all);
  const FactsPass parts = merge(measure_facts(all.first(137)), measure_facts(all.subspan(137)));
  EXPECT_EQ(whole.facts.sphere_count, parts.facts.sphere_count);
  EXPECT_EQ(whole.facts.r_max, parts.facts.r_max);
  EXPECT_EQ(whole.facts.r_min_nonzero, parts.facts.r_min_nonzero);
  for (int a = 0; a < 3; ++a) {
    EXPECT_EQ(whole.facts.lowest[a], parts.facts.lowest[a]);
    EXPECT_EQ(whole.facts.highest[a], parts.facts.highest[a]);
  }
}

}  // namespace
}  // namespace octocell::cpu
