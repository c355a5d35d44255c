// SPDX-License-Identifier: MIT
// Method half_shell of impl_cuda_custom: any levels, seams, the fused stage. Needs a CUDA device;
// elsewhere every test says why it was skipped.
#include <gtest/gtest.h>

#include "harness/driver/complete.hpp"
#include "harness/reference/reference.hpp"
#include "harness/scenes/scenes.hpp"
#include "impl_cuda_custom/backend.hpp"

namespace octocell {
namespace {

class HalfShellOnDevice : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto reason = cuda_custom::why_unavailable()) GTEST_SKIP() << *reason;
    finder_ = cuda_custom::make_backend();
  }
  std::unique_ptr<PairFinder> finder_;
};

/// Finds the pairs with the levels that end at `cuts` and with the greatest radius.
PairDigest found_with_levels(PairFinder& finder, const Scene& scene, std::vector<float> cuts,
                             double diameters, std::uint32_t columns, int most_bits) {
  Plan plan = make_plan(measure(scene.view()), {.method = Method::half_shell});
  cuts.push_back(plan.facts.r_max);
  plan.levels = {};
  for (const float r_max : cuts) {
    Level level = make_level(plan.facts, r_max, diameters * 2.0 * r_max, columns, most_bits);
    if (plan.levels.count > 0) {
      const Level& below = plan.levels.level[plan.levels.count - 1];
      level.first_id = below.first_id + below.ids;
    }
    plan.levels.level[plan.levels.count++] = level;
  }
  plan.key_bits = key_bits_of(plan.levels);
  HostClock clock;
  complete(finder, scene.view(), plan, clock);
  return finder.digest();
}

TEST_F(HalfShellOnDevice, AnyLevelsAreExact) {
  for (const char* spec : {"poly:n=3000", "discs:n=3000", "giant:n=2000", "lattice:n=2000",
                           "cluster:n=3000", "chain:n=600"}) {
    const Scene scene = generate(spec);
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
    const float r_max = measure(scene.view()).facts.r_max;
    const std::vector<float> choices[] = {
        {}, {r_max / 2}, {r_max / 4, r_max / 3}, {r_max / 50, r_max / 9, r_max / 5, r_max / 2}};
    for (const std::vector<float>& cuts : choices) {
      for (const double diameters : {1.0, 1.7, 40.0}) {
        for (const std::uint32_t columns : {1U, 2U, 3U, 8U}) {
          EXPECT_EQ(found_with_levels(*finder_, scene, cuts, diameters, columns, 28), truth)
              << spec << ", " << cuts.size() << " cuts, " << diameters << " diameters, " << columns
              << " columns";
        }
      }
    }
  }
}

/// Clouds of spheres at places that share ids when axes wrap, if `apart` is a period; if it is a
/// little less, the clouds lie across the border of periods.
Scene clouds_on_a_lattice(float apart) {
  Scene scene = generate("gas:n=2000");
  std::uint32_t k = 0;
  for (Sphere& s : scene.spheres) {
    s.x = std::fmod(s.x, 2.0F) + apart * static_cast<float>(k % 3);
    s.y = std::fmod(s.y, 2.0F) + apart * static_cast<float>(k / 3 % 3);
    s.z = std::fmod(s.z, 2.0F) + apart * static_cast<float>(k / 9 % 3);
    ++k;
  }
  return scene;
}

TEST_F(HalfShellOnDevice, FarCellsThatShareIdsLoseNoPair) {
  for (const float apart : {512.0F, 510.5F}) {
    const Scene scene = clouds_on_a_lattice(apart);
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
    ASSERT_GT(truth.count, 1000U);
    for (const std::uint32_t columns : {1U, 2U, 4U}) {
      EXPECT_EQ(found_with_levels(*finder_, scene, {}, 1.0, columns, 27), truth) << columns;
      EXPECT_EQ(found_with_levels(*finder_, scene, {}, 1.0, columns, 24), truth) << columns;
    }
  }
}

TEST_F(HalfShellOnDevice, HalfShellNamesTheStageThatHoldsBounds) {
  const Outcome outcome =
      find_completely(*finder_, generate("gas:n=5000").view(), {.method = Method::half_shell});
  EXPECT_TRUE(outcome.times.stage_ms[index_of(Stage::bounds)]);
  EXPECT_EQ(outcome.times.fused_into[index_of(Stage::cell_ids)], Stage::bounds);
}

}  // namespace
}  // namespace octocell
