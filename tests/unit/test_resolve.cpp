// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/support/cpu_pipeline.hpp"

namespace octocell::cpu {
namespace {

std::unique_ptr<Workspace> with_uncertain_pairs(const Scene& scene,
                                                const std::vector<Pair>& uncertain_pairs) {
  auto w = workspace_for(scene.view(), {.threads = 2});
  w->uncertain_pairs.allocate(uncertain_pairs.size());
  w->pairs.clear(false);
  w->uncertain_pairs.append(uncertain_pairs);
  resolve(*w);
  return w;
}

TEST(Resolve, KeepsTheUncertainPairsThatOverlapAndNoOthers) {
  const Scene scene = generate("lattice:n=1331");  // 11 x 11 x 11: every neighbour is tangent
  std::vector<Pair> uncertain_pairs;
  for (std::uint32_t i = 0; i < 1331; ++i) {
    for (std::uint32_t j = i + 1; j < std::min(i + 130, 1331U); ++j)
      uncertain_pairs.push_back({i, j});
  }
  const auto stored = with_uncertain_pairs(scene, uncertain_pairs);
  std::vector<Pair> expected;
  for (const Pair& p : uncertain_pairs) {
    if (reference::overlap(scene.spheres[p.i], scene.spheres[p.j])) expected.push_back(p);
  }
  EXPECT_EQ(expected.size(), 3U * 11 * 11 * 10);
  EXPECT_EQ(stored->pairs.digest(), digest_of(expected));
}

TEST(Resolve, HappensInStageFiveWhereNothingMayBeKept) {
  const Scene scene = generate("lattice:n=1331");  // nothing but uncertain pairs
  auto w = workspace_for(
      scene.view(),
      {.threads = 2, .count_only = true, .allowed = Skips::all().without(Skip::uncertain_pairs)});
  ASSERT_EQ(w->plan.capacity.uncertain_pairs, 0U);
  bounds(*w);
  cell_ids(*w);
  sort(*w);
  cell_index(*w);
  pair_tests(*w);
  resolve(*w);
  EXPECT_EQ(w->uncertain_pairs.size(), 3U * 11 * 11 * 10);
  EXPECT_EQ(w->pairs.digest(), digest_of(reference::exact_pairs(scene.spheres)));
}

TEST(Resolve, WithoutUncertainPairsAddsNothing) {
  const Scene scene = generate("gas:n=100");
  EXPECT_EQ(with_uncertain_pairs(scene, {})->pairs.size(), 0U);
}

}  // namespace
}  // namespace octocell::cpu
