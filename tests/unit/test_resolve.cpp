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

std::unique_ptr<Workspace> with_doubts(const Scene& scene, const std::vector<Pair>& doubts) {
  auto w = workspace_for(scene.view(), {.threads = 2});
  w->doubts.allocate(doubts.size());
  w->pairs.clear(false);
  w->doubts.append(doubts);
  resolve(*w);
  return w;
}

TEST(Resolve, KeepsTheDoubtsThatOverlapAndNoOthers) {
  const Scene scene = generate("lattice:n=1331");  // 11 x 11 x 11: every neighbour is tangent
  std::vector<Pair> doubts;
  for (std::uint32_t i = 0; i < 1331; ++i) {
    for (std::uint32_t j = i + 1; j < std::min(i + 130, 1331U); ++j) doubts.push_back({i, j});
  }
  const auto stored = with_doubts(scene, doubts);
  std::vector<Pair> expected;
  for (const Pair& p : doubts) {
    if (reference::overlap(scene.spheres[p.i], scene.spheres[p.j])) expected.push_back(p);
  }
  EXPECT_EQ(expected.size(), 3U * 11 * 11 * 10);
  EXPECT_EQ(stored->pairs.digest(), digest_of(expected));
}

TEST(Resolve, HappensInStageFiveWhereNothingMayBeKept) {
  const Scene scene = generate("lattice:n=1331");  // nothing but doubts
  auto w = workspace_for(
      scene.view(),
      {.threads = 2, .count_only = true, .allowed = Skips::all().without(Skip::doubts)});
  ASSERT_EQ(w->plan.capacity.doubts, 0U);
  bounds(*w);
  cell_ids(*w);
  sort(*w);
  cell_index(*w);
  pair_tests(*w);
  resolve(*w);
  EXPECT_EQ(w->doubts.size(), 3U * 11 * 11 * 10);
  EXPECT_EQ(w->pairs.digest(), digest_of(reference::exact_pairs(scene.spheres)));
}

TEST(Resolve, WithoutDoubtsAddsNothing) {
  const Scene scene = generate("gas:n=100");
  EXPECT_EQ(with_doubts(scene, {})->pairs.size(), 0U);
}

}  // namespace
}  // namespace octocell::cpu
