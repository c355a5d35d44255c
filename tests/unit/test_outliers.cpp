// SPDX-License-Identifier: MIT
// A few spheres that are far away, or of another size, must not make work for all others: the pairs
// are exact, and there are few candidates. Work is limited, not time, because times depend on the
// machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/planner/bulk.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/support/ask_finder.hpp"

namespace octocell {
namespace {

constexpr std::uint64_t kCandidatesOfOne = 250;  // old plans: thousands, half of all spheres
constexpr std::size_t kCount = 20000;

struct Spoilt {
  std::string name;
  std::vector<Sphere> spheres;
};

std::vector<Sphere> bulk() { return generate("gas:n=20000").spheres; }

/// So many of a gas at distances of 10^low to 10^high in random directions; each has a partner.
std::vector<Sphere> with_far_ones(std::size_t count, double low, double high) {
  std::vector<Sphere> spheres = bulk();
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(low, high);
  for (std::size_t k = 0; k < count; k += 2) {
    double direction[3];
    for (double& d : direction) d = normal(random);
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    const double distance = std::pow(10.0, exponent(random)) / length;
    Sphere& s = spheres[k * spheres.size() / count];
    s.x = static_cast<float>(direction[0] * distance);
    s.y = static_cast<float>(direction[1] * distance);
    s.z = static_cast<float>(direction[2] * distance);
    spheres[(k + 1) * spheres.size() / count] = s;
  }
  return spheres;
}

std::vector<Spoilt> far_scenes() {
  std::vector<Spoilt> scenes;
  const auto add = [&](std::string name, std::vector<Sphere> spheres,
                       const std::function<void(std::vector<Sphere>&)>& spoil = {}) {
    if (spoil) spoil(spheres);
    scenes.push_back({std::move(name), std::move(spheres)});
  };
  add("one at 3e38", bulk(), [](auto& s) { s[77] = {3e38F, 3e38F, -3e38F, 0.5F}; });
  add("eight at 1e10 to 1e30", with_far_ones(8, 10, 30));
  add("four per cent at 1e8 to 1e30", with_far_ones(800, 8, 30));
  add("eight per cent at 1e12", with_far_ones(1600, 12, 12.1));
  add("ten on one axis", bulk(), [](auto& s) {
    for (std::size_t k = 0; k < 10; ++k) s[k * 1999].x = 1e25F * static_cast<float>(1 + k % 5);
  });
  add("giants far away", bulk(), [](auto& s) {
    s[5] = {1e20F, -1e20F, 1e20F, 1e15F};
    s[6] = {1e20F, -1e20F, 1.00001e20F, 1e16F};
    s[7] = {-1e30F, 0, 0, 1e20F};
  });
  add("a giant that reaches half of all", bulk(), [](auto& s) {
    s[5] = {-1e10F, 20.0F, 20.0F, 1e10F};
    s[6] = {3e30F, 3e30F, 3e30F, 1.0F};
  });
  std::vector<Sphere> poly = generate("poly:n=20000,ratio=100").spheres;
  poly[123].z = -1e33F;
  add("radii that differ", poly);
  std::vector<Sphere> flat = generate("discs:n=20000").spheres;
  flat[99] = {1e35F, -1e35F, 1e34F, flat[99].r};
  add("discs", flat);
  return scenes;
}

std::vector<Spoilt> scenes_with_points() {
  const auto points = [](float r) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> place(0.0F, 1.0F);
    std::vector<Sphere> spheres(kCount);
    for (Sphere& s : spheres) s = {place(random), place(random), place(random), 0.0F};
    spheres[kCount / 2] = {0.5F, 0.5F, 0.5F, r};
    spheres[1] = spheres[kCount - 1];  // two points that are one
    return spheres;
  };
  std::vector<Spoilt> scenes = {{"points and a sphere", points(0.5F)},
                                {"points and a small sphere", points(0.01F)},
                                {"points and one tiny number", points(1e-40F)}};
  std::vector<Sphere> far = points(0.5F);
  far[3].y = 1e38F;
  scenes.push_back({"points, a sphere and a point far away", far});
  std::vector<Sphere> half = bulk();
  for (std::size_t k = 0; k < half.size(); k += 2) half[k].r = 0.0F;
  scenes.push_back({"half a gas of points", half});
  return scenes;
}

std::vector<Implementation> with_grids() {
  std::vector<Implementation> all = implementations();
  std::erase_if(all, [](const Implementation& how) {
    return how.is_baseline() || how.backend->why_unavailable() || how.rule != Rule::lowest_cell ||
           how.method == Method::brute_force;
  });
  return all;
}

void expect_little_work(const Spoilt& scene, PlanOptions (*options)(PlanOptions)) {
  const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
  for (const Implementation& how : with_grids()) {
    const std::unique_ptr<PairFinder> finder = how.backend->create();
    const Outcome outcome = find_completely(*finder, {scene.spheres}, options(how.plan_options(2)));
    EXPECT_EQ(finder->digest(), truth) << scene.name << ", " << how.label();
    if (how.method == Method::tiles) continue;  // it has one size of cells, for the largest sphere
    EXPECT_LT(outcome.counts.candidates, kCandidatesOfOne * scene.spheres.size())
        << scene.name << ", " << how.label();
  }
}

TEST(Outliers, FarAwayMakeNoWorkForOthers) {
  for (const Spoilt& scene : far_scenes()) {
    expect_little_work(scene, [](PlanOptions options) { return options; });
  }
}

TEST(Outliers, FarAwayMakeNoWorkForOthersThatMove) {
  for (const Spoilt& scene : far_scenes()) {
    expect_little_work(scene, [](PlanOptions options) {
      options.moving = true;
      return options;
    });
  }
}

TEST(Outliers, AmongPointsMakeNoWorkForThem) {
  for (const Spoilt& scene : scenes_with_points()) {
    expect_little_work(scene, [](PlanOptions options) { return options; });
  }
}

TEST(Outliers, LeaveACellSideThatWasAskedFor) {
  for (const Spoilt& scene : far_scenes()) {
    const PlanOptions options = {.cell_side = 2.0};
    const Plan plan = make_plan(measure({scene.spheres}), options);
    EXPECT_LT(plan.grid.cell_side, 2.1) << scene.name;
  }
}

/// Then each plan is what it was before there were such boxes.
TEST(Outliers, AreNotSeenInOrdinaryScenes) {
  for (const SceneInfo& info : scenes()) {
    for (const char* n : {"100", "1025", "20000", "65000"}) {
      for (const char* seed : {"1", "2"}) {
        std::string spec = std::string(info.name) + ":n=" + n;
        const bool has_seed = std::ranges::any_of(
            info.parameters, [](const ParameterInfo& p) { return p.name == "seed"; });
        if (has_seed) spec += std::string(",seed=") + seed;
        EXPECT_TRUE(measure(generate(spec).view()).bulk.empty()) << spec;
      }
    }
  }
}

TEST(Outliers, DoNotWidenTheBoxOfTheBulk) {
  const PlanFacts gas = measure({bulk()}).facts;
  for (const Spoilt& scene : {far_scenes()[0], far_scenes()[1], far_scenes()[2]}) {
    const SceneStats stats = measure({scene.spheres});
    ASSERT_FALSE(stats.bulk.empty()) << scene.name;
    const Bulk& closest = stats.bulk.back();
    for (int a = 0; a < 3; ++a) {
      EXPECT_LE(closest.lowest[a], gas.lowest[a] + 1.0F) << scene.name;
      EXPECT_GE(closest.highest[a], gas.highest[a] - 1.0F) << scene.name;
      const float width = gas.highest[a] - gas.lowest[a];
      EXPECT_LE(closest.highest[a] - closest.lowest[a], 2.0F * width) << scene.name;
    }
  }
}

/// Any box will do: those that most spheres are outside of, too, with ids that wrap.
TEST(Outliers, AreExactWhereverTheGridLies) {
  const Scene scene = generate("poly:n=2000,ratio=4");
  const PairDigest truth = digest_of(reference::exact_pairs(scene));
  const SceneStats stats = measure(scene.view());
  std::mt19937 random(11);
  for (int trial = 0; trial < 60; ++trial) {
    Bulk box;
    for (int a = 0; a < 3; ++a) {
      const float low = stats.facts.lowest[a];
      const float width = stats.facts.highest[a] - low;
      std::uniform_real_distribution<float> place(low - width / 4, low + 5 * width / 4);
      box.lowest[a] = place(random);
      box.highest[a] = trial % 5 == 0 ? box.lowest[a] : place(random);
      if (box.highest[a] < box.lowest[a]) std::swap(box.lowest[a], box.highest[a]);
    }
    const PlanFacts facts = only_bulk(stats, box).facts;
    const double side = std::ldexp(stats.facts.r_max, static_cast<int>(random() % 5) - 2);
    for (const Implementation& how : with_grids()) {
      if (how.planned()) continue;
      Plan plan = make_plan(stats, how.plan_options(2));
      plan.capacity.pairs = plan.capacity.uncertain_pairs = 100 * scene.spheres.size();
      if (how.method == Method::home_phantom) {
        plan.grid = make_grid(facts, side, widest_box(facts, facts.r_max));
        plan.key_bits = plan.grid.key_bits;
      } else {
        plan.levels.count = 1;
        plan.levels.level[0] =
            make_level(facts, facts.r_max, side, 1U << trial % 4, trial % 2 == 0 ? 28 : 10);
        plan.key_bits = key_bits_of(plan.levels);
      }
      const std::unique_ptr<PairFinder> finder = how.backend->create();
      EXPECT_EQ(ask_until_it_fits(*finder, plan, scene.view()).digest, truth)
          << trial << ", " << how.label();
    }
  }
}

}  // namespace
}  // namespace octocell
