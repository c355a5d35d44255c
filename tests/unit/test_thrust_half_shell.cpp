// SPDX-License-Identifier: MIT
// Where half_shell of impl_thrust searches, in levels and wrapped grids that the planner would not
// choose: all pairs of adjacent cells, each once, and no others.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>

#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_thrust/backend.hpp"
#include "tests/support/level_cuts.hpp"

namespace octocell {
namespace {

/// How far apart two cells are on an axis: round the seam, where that is nearer.
std::uint32_t cells_apart(const Grid& grid, int axis, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t mask = grid.wrap_mask[axis];
  const std::uint32_t apart = std::max(a & mask, b & mask) - std::min(a & mask, b & mask);
  return grid.wraps(axis) ? std::min(apart, grid.period(axis) - apart) : apart;
}

/// Pairs in adjacent cells of the coarser one's grid.
std::uint64_t adjacent_pairs(const Levels& levels, std::span<const Sphere> spheres) {
  std::uint64_t pairs = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Sphere& p = spheres[i];
      const Sphere& q = spheres[j];
      const Level& level = levels.level[level_of(levels, std::max(p.r, q.r))];
      const Cell a = cell_of(level.grid, p.x, p.y, p.z);
      const Cell b = cell_of(level.grid, q.x, q.y, q.z);
      const bool adjacent = cells_apart(level.grid, 0, a.x, b.x) <= level.column_reach &&
                            cells_apart(level.grid, 1, a.y, b.y) <= 1 &&
                            cells_apart(level.grid, 2, a.z, b.z) <= 1;
      pairs += adjacent ? 1 : 0;
    }
  }
  return pairs;
}

TEST(ThrustHalfShell, LooksOnceAtAllPairsOfAdjacentCellsHoweverTheyAreCut) {
  bool wrapped[3] = {};
  const Scene scenes[] = {generate("poly:n=600"),        generate("giant:n=600"),
                          generate("gas:n=900"),         generate("discs:n=600"),
                          far_apart("poly:n=600", 1e4F), far_apart("gas:n=300", 1e7F)};
  for (std::size_t scene_number = 0; scene_number < std::size(scenes); ++scene_number) {
    const Scene& scene = scenes[scene_number];
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
    const Plan planned = roomy_plan(scene, {.method = Method::half_shell});
    for (const std::size_t levels : {1, 3}) {
      for (const std::uint32_t columns : {1, 3, 8}) {
        for (const double diameters : {1.0, 2.5}) {
          for (const int bits : {9, 12, 28}) {
            const Plan plan = with_levels(planned, scene, {levels, columns, diameters, bits});
            const auto finder = on_thrust::make_host_backend();
            const FinderAnswer answer = ask_until_it_fits(*finder, plan, scene.view());
            const std::string what =
                fmt::format("scene {}, {} levels, {} columns, {} diameters, {} bits", scene_number,
                            levels, columns, diameters, bits);
            EXPECT_EQ(answer.digest, truth) << what;
            EXPECT_EQ(answer.counts.candidates, adjacent_pairs(plan.levels, scene.spheres)) << what;
            for (int a = 0; a < 3; ++a) wrapped[a] |= plan.levels.level[0].grid.wraps(a);
          }
        }
      }
    }
  }
  EXPECT_TRUE(wrapped[0] && wrapped[1] && wrapped[2]);
}

TEST(ThrustHalfShell, AnswersTheSameWhereIdsComeInOrderSortedOrNot) {
  Scene scene = generate("poly:n=5000");
  Plan plan = roomy_plan(scene, {.method = Method::half_shell});
  const auto column = [&](const Sphere& s) {
    const Level& level = plan.levels.level[level_of(plan.levels, s.r)];
    return level.first_id + cell_id(level.grid, cell_of(level.grid, s.x, s.y, s.z));
  };
  std::ranges::stable_sort(scene.spheres, {}, column);
  for (const bool in_order : {true, false}) {
    if (!in_order) std::swap(scene.spheres.front(), scene.spheres.back());
    const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
    for (const Skips allowed : {Skips::all(), Skips::all().without(Skip::sort)}) {
      plan.allowed = allowed;
      const auto finder = on_thrust::make_host_backend();
      EXPECT_EQ(ask(*finder, plan, scene.view()).digest, truth) << in_order;
    }
  }
}

TEST(ThrustHalfShell, AGiantCostsEachOtherSphereOneLook) {
  const Scene scene = generate("giant:n=3000");
  const Plan plan = roomy_plan(
      scene, {.method = Method::half_shell, .costs = backend_named("impl_thrust").costs});
  ASSERT_GT(plan.levels.count, 1);
  const auto finder = on_thrust::make_host_backend();
  const Counts found = ask(*finder, plan, scene.view()).counts;
  EXPECT_LT(found.candidates, 100 * scene.spheres.size());
}

}  // namespace
}  // namespace octocell
