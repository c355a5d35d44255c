// SPDX-License-Identifier: MIT
// The correctness matrix: every implementation, every scene, the exact pair set.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/support/sanitized.hpp"

namespace octocell {
namespace {

/// Scenes that give even a library with known issues no occasion for them.
bool is_harmless(const std::string& what) {
  return what.starts_with("gas:") || what.starts_with("dense:") || what.starts_with("poly:");
}

/// Expects the exact set, or (rule chapter32 only) a refusal with a reason. A library with known
/// faults may lose pairs (test_baselines_faults.cpp), and never makes one up.
void expect_exact(const Implementation& how, std::span<const Sphere> spheres,
                  const std::vector<Pair>& truth, const std::string& what,
                  Skips allowed = Skips::all()) {
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  PlanOptions options = how.plan_options(2);
  options.allowed = options.allowed.both(allowed);
  Plan plan;
  Skips left_out;
  try {
    const Outcome outcome = find_completely(*finder, {spheres}, options);
    plan = outcome.plan;
    left_out = plan.taken.either(outcome.counts.used);
  } catch (const LimitError& refusal) {
    EXPECT_EQ(how.rule, Rule::chapter32) << what << ": " << refusal.what();
    return;
  }
  const std::vector<Pair> pairs = finder->download();
  const reference::Comparison difference = reference::compare(pairs, truth);
  const bool may_lose = how.has_known_issues() && !is_harmless(what);
  EXPECT_EQ(finder->digest(), digest_of(may_lose ? pairs : truth)) << what;
  EXPECT_TRUE(difference.missed == 0 || may_lose) << what << ": missed " << difference.missed;
  EXPECT_EQ(difference.false_pairs, 0U) << what;
  EXPECT_EQ(difference.duplicates, 0U) << what;
  if (!how.is_baseline()) {
    EXPECT_EQ(left_out.either(options.allowed), options.allowed) << what << ": more than it may";
  }
  if (!plan.taken.has(Skip::uncertain_pairs)) return;
  // On a lattice nothing is uncertain: once more with the test that other scenes need.
  expect_exact(how, spheres, truth, what + " without skip uncertain pairs",
               Skips::all().without(Skip::uncertain_pairs));
}

std::vector<Implementation> correct_implementations() {
  std::vector<Implementation> correct = implementations();
  std::ranges::copy(other_predicates(), std::back_inserter(correct));
  std::erase_if(correct, [](const Implementation& how) {
    return how.negative_control() || how.backend->why_unavailable();
  });
  return correct;
}

class BackendsAgree : public testing::TestWithParam<Implementation> {};

TEST_P(BackendsAgree, OnEveryGenerator) {
  for (const SceneInfo& info : scenes()) {
    for (const int n : {0, 1, 2, 31, 33, 1025, kSanitized ? 1500 : 4000}) {
      const std::string spec = fmt::format("{}:n={}", info.name, n);
      const Scene scene = generate(spec);
      expect_exact(GetParam(), scene.spheres, reference::exact_pairs(scene.spheres), spec);
    }
  }
}

std::vector<Sphere> all_radii_zero() {
  std::vector<Sphere> spheres = generate("gas:n=500").spheres;
  for (Sphere& s : spheres) s.r = 0.0F;
  for (int k = 0; k < 50; ++k) spheres.push_back(spheres[static_cast<std::size_t>(3 * k)]);
  return spheres;
}

std::vector<Sphere> doubles_an_ulp_apart() {
  std::vector<Sphere> spheres;
  for (const Sphere& s : generate("lattice:n=512").spheres) {
    spheres.push_back(s);
    Sphere twin = s;
    twin.x = std::nextafter(s.x, 100.0F);
    twin.r = std::nextafter(s.r, 0.0F);
    spheres.push_back(twin);
  }
  return spheres;
}

std::vector<Sphere> nine_decades_of_radius() {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 1500; ++k) {
    const auto r = static_cast<float>(std::pow(10.0, -6.0 + 9.0 * unit(random)));
    const auto place = [&] { return static_cast<float>((unit(random) - 0.5) * 4e4); };
    spheres.push_back({place(), place(), place(), r});
  }
  return spheres;
}

std::vector<Sphere> two_clusters_far_apart() {
  std::vector<Sphere> spheres = generate("gas:n=1000").spheres;
  for (std::size_t i = 0; i < spheres.size(); i += 2) {
    Sphere& s = spheres[i];
    s = {s.x + 1e10F, s.y + 1e10F, s.z - 1e10F, 300.0F};
  }
  return spheres;
}

std::vector<Sphere> scaled(const char* spec, float factor) {
  std::vector<Sphere> spheres = generate(spec).spheres;
  for (Sphere& s : spheres) s = {s.x * factor, s.y * factor, s.z * factor, s.r * factor};
  return spheres;
}

std::vector<Sphere> borders_of_cells() {
  std::mt19937 random(3);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 2000; ++k) {
    const auto coordinate = [&] {
      float v = static_cast<float>(static_cast<int>(random() % 16) - 8) * 0.7F;
      for (unsigned step = random() % 4; step > 0; --step) v = std::nextafter(v, 1e9F);
      return v;
    };
    spheres.push_back({coordinate(), coordinate(), coordinate(), 0.35F});
  }
  return spheres;
}

std::vector<Sphere> plane_among_dust() {
  std::vector<Sphere> spheres = generate("gas:n=500").spheres;
  spheres.push_back({0, 0, -0x1.8p125F, 0x1.8p125F});
  return spheres;
}

TEST_P(BackendsAgree, OnScenesMadeToBreakThem) {
  const std::pair<const char*, std::vector<Sphere>> kScenes[] = {
      {"all radii zero", all_radii_zero()},
      {"doubles an ulp apart", doubles_an_ulp_apart()},
      {"nine decades of radius", nine_decades_of_radius()},
      {"two clusters 1e10 apart", two_clusters_far_apart()},
      {"gas of 1e-39", scaled("gas:n=500", 1e-39F)},
      {"lattice of 2^-149 steps", scaled("lattice:n=343", 0x1p-148F)},
      {"lattice of 2^120 steps", scaled("lattice:n=343", 0x1p120F)},
      {"poly of 1e20", scaled("poly:n=1000", 1e20F)},
      {"borders of cells", borders_of_cells()},
      {"lattice of 0.1 steps", scaled("lattice:n=1000", 0.1F)},
      {"a plane's stand-in among dust", plane_among_dust()},
  };
  for (const auto& [what, spheres] : kScenes) {
    expect_exact(GetParam(), spheres, reference::exact_pairs(spheres), what);
  }
}

/// Baselines promise nothing at the ends of float32 (baselines/README.md).
class OurBackendsAgree : public testing::TestWithParam<Implementation> {};

TEST_P(OurBackendsAgree, OnRandomBits) {
  std::mt19937 random(17);
  for (int round = 0; round < 300; ++round) {
    std::vector<Sphere> spheres;
    while (spheres.size() < 40) {
      const auto any = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random())); };
      const Sphere s = {any(), any(), any(), std::fabs(any())};
      if (std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.r)) {
        spheres.push_back(s);
      }
    }
    expect_exact(GetParam(), spheres, reference::exact_pairs(spheres), "random bits");
  }
}

std::vector<Implementation> our_implementations() {
  std::vector<Implementation> ours = correct_implementations();
  std::erase_if(ours, [](const Implementation& how) { return how.is_baseline(); });
  return ours;
}

std::string test_name(const testing::TestParamInfo<Implementation>& how) {
  std::string name = how.param.label();
  for (char& c : name) c = std::isalnum(c) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, BackendsAgree, testing::ValuesIn(correct_implementations()),
                         test_name);
INSTANTIATE_TEST_SUITE_P(All, OurBackendsAgree, testing::ValuesIn(our_implementations()),
                         test_name);

TEST(LowestCell, IsExactForAnyCellSide) {
  for (const char* spec : {"poly:n=2000", "giant:n=1000", "shifted:n=1000,offset=3e6"}) {
    const Scene scene = generate(spec);
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
    for (const double side : {0.15, 0.5, 1.0, 3.0, 1e3, 1e30}) {
      const auto finder = backend_named("impl_cpu").create();
      find_completely(*finder, scene.view(), {.cell_side = side});
      EXPECT_EQ(finder->digest(), truth) << spec << ", side " << side;
    }
  }
}

TEST(LowestCell, IsExactWhenIdsWrap) {
  for (const double offset : {1e5, 1e7, 1e9, 1e12}) {
    std::vector<Sphere> spheres = generate("dense:n=1500").spheres;
    for (std::size_t i = 0; i < spheres.size(); i += 3) {
      spheres[i].x = static_cast<float>(spheres[i].x + offset);
      spheres[i].y = static_cast<float>(spheres[i].y - offset);
    }
    const auto finder = backend_named("impl_cpu").create();
    for (const double side : {1.0, 3.0}) {
      const Outcome outcome = find_completely(*finder, {spheres}, {.cell_side = side});
      EXPECT_EQ(finder->digest(), digest_of(reference::exact_pairs(spheres)))
          << offset << "\n"
          << name_of(outcome.plan.method);
    }
  }
}

}  // namespace
}  // namespace octocell
