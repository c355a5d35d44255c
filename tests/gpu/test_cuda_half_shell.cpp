// SPDX-License-Identifier: MIT
// Method half_shell of impl_cuda_custom: any levels, seams, the fused stage. Needs a CUDA device;
// without one every test says why it was skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "harness/engine/find_completely.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
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

/// A line of spheres, each in a column of its own, in order, with keys of that many bits.
struct Line {
  std::vector<Sphere> spheres;
  Plan plan;
};
Line line_in_order(std::size_t count, int bits) {
  Line line;
  for (std::size_t k = 0; k < count; ++k) {
    line.spheres.push_back({0.75F * static_cast<float>(k), 0.0F, 0.0F, 0.5F});
  }
  line.plan = make_plan(measure({line.spheres}), {.method = Method::half_shell});
  line.plan.levels = {.count = 1, .level = {make_level(line.plan.facts, 0.5F, 1.0, 4, 28)}};
  line.plan.key_bits = std::max(key_bits_of(line.plan.levels), bits);
  return line;
}

/// However many passes are left out: the ids are looked for on the side where the last would be.
TEST_F(HalfShellOnDevice, SpheresInOrderAreNotSorted) {
  for (const std::size_t count : {1, 31, 33, 513, 20000, 300001}) {
    for (const int bits : {1, 20, 28, 32}) {
      Line line = line_in_order(count, bits);
      const PairDigest truth = digest_of(reference::exact_pairs(line.spheres));
      for (const bool allowed : {true, false}) {
        if (!allowed) line.plan.allowed = line.plan.allowed.without(Skip::sort);
        HostClock clock;
        const Outcome outcome = complete(*finder_, {line.spheres}, line.plan, clock);
        EXPECT_EQ(outcome.counts.used.has(Skip::sort), allowed) << count << ", " << bits;
        EXPECT_EQ(finder_->digest(), truth) << count << ", " << bits;
      }
    }
  }
}

/// Each overlaps the next. `swapped` and the one behind it have each other's places.
PairDigest pairs_of_line(std::size_t count, std::size_t swapped) {
  const auto sphere_at = [&](std::size_t place) {
    return static_cast<std::uint32_t>(place == swapped       ? place + 1
                                      : place == swapped + 1 ? place - 1
                                                             : place);
  };
  std::vector<Pair> pairs;
  for (std::size_t place = 0; place + 1 < count; ++place) {
    const auto [i, j] = std::minmax({sphere_at(place), sphere_at(place + 1)});
    pairs.push_back({i, j});
  }
  return digest_of(pairs);
}

/// Wherever one is out of order: within a warp's part, between two of them, at the ends.
TEST_F(HalfShellOnDevice, ASphereOutOfOrderIsNoticed) {
  constexpr std::size_t kCount = 300001;
  const Line line = line_in_order(kCount, 20);
  std::vector<std::size_t> places = {kCount - 2};
  for (std::size_t place = 0; place + 1 < kCount; place += 4001) places.push_back(place);
  for (std::size_t place = 31; place < 3000; place += 32) places.push_back(place);
  for (const std::size_t place : places) {
    std::vector<Sphere> spheres = line.spheres;
    std::swap(spheres[place], spheres[place + 1]);
    HostClock clock;
    const Outcome outcome = complete(*finder_, {spheres}, line.plan, clock);
    EXPECT_FALSE(outcome.counts.used.has(Skip::sort)) << place;
    EXPECT_EQ(finder_->digest(), pairs_of_line(kCount, place)) << place;
  }
}

}  // namespace
}  // namespace octocell
