// SPDX-License-Identifier: MIT
// Method half_shell of impl_cpu: its levels, its rows, its seams, its skips.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <vector>

#include "harness/engine/find_completely.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cpu/backend.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/half_shell/row_cursor.hpp"
#include "tests/support/cpu_pipeline.hpp"
#include "tests/support/level_cuts.hpp"

namespace octocell::cpu {
namespace {

Outcome find_in(SceneView scene, const PlanOptions& options, PairDigest& digest) {
  const auto finder = make_backend();
  const Outcome outcome = find_completely(*finder, scene, options);
  digest = finder->digest();
  return outcome;
}

PairDigest exact_digest(SceneView scene) {
  return digest_of(reference::exact_pairs(scene.spheres));
}

constexpr const char* kScenes[] = {"gas:n=0",
                                   "gas:n=1",
                                   "gas:n=2",
                                   "gas:n=15",
                                   "gas:n=16",
                                   "gas:n=17",
                                   "gas:n=4095",
                                   "gas:n=4097",
                                   "gas:n=16385",
                                   "dense:n=20000",
                                   "poly:n=20000",
                                   "poly:n=20000,ratio=1e6",
                                   "cluster:n=20000",
                                   "giant:n=20000",
                                   "discs:n=20000",
                                   "chain:n=20000",
                                   "identical:n=700",
                                   "lattice:n=9261",
                                   "lattice:n=9261,shuffle=1",
                                   "gas:n=20000,phi=1e-6",
                                   "shifted:n=20000,offset=1e7",
                                   "shifted:n=2000,offset=1e30"};

class HalfShell : public testing::TestWithParam<const char*> {};

TEST_P(HalfShell, FindsTheExactPairsWithAnySkipForbidden) {
  const Scene scene = generate(GetParam());
  const PairDigest truth = exact_digest(scene.view());
  for (const int threads : {1, 3}) {
    for (std::size_t k = 0; k <= kSkipCount; ++k) {
      if (static_cast<Skip>(k) == Skip::phantoms) continue;  // the method is made of it
      const Skips allowed =
          k == kSkipCount ? Skips::all() : Skips::all().without(static_cast<Skip>(k));
      PairDigest found;
      find_in(scene.view(), {.method = Method::half_shell, .threads = threads, .allowed = allowed},
              found);
      EXPECT_EQ(found, truth) << threads << " threads, skip " << k << " forbidden";
    }
  }
}

TEST_P(HalfShell, CountsWithoutKeeping) {
  const Scene scene = generate(GetParam());
  PairDigest found;
  find_in(scene.view(), {.method = Method::half_shell, .threads = 2, .count_only = true}, found);
  EXPECT_EQ(found, exact_digest(scene.view()));
}

INSTANTIATE_TEST_SUITE_P(Scenes, HalfShell, testing::ValuesIn(kScenes));

/// Two clouds so far apart that ids of x, y and z repeat, across the seams of their periods.
std::vector<Sphere> clouds_on_seams() {
  std::vector<Sphere> spheres;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> inside(-6.0F, 6.0F);
  for (const float far : {-4e6F, 0.0F, 4e6F}) {
    for (int k = 0; k < 700; ++k) {
      spheres.push_back({far + inside(random), far + inside(random), far + inside(random), 0.5F});
    }
  }
  return spheres;
}

TEST(HalfShellWraps, PairsAcrossASeamAreFoundOnce) {
  // Moved step by step, so that every part of a cloud comes to lie on a seam.
  for (int step = 0; step < 24; ++step) {
    std::vector<Sphere> spheres = clouds_on_seams();
    for (std::size_t k = 700; k < 1400; ++k) spheres[k].x += 64.0F * static_cast<float>(step);
    const SceneView scene = {spheres};
    const PlanOptions options = {.method = Method::half_shell};
    const Plan plan = make_plan(measure(scene), options);
    ASSERT_TRUE(plan.levels.level[0].grid.wraps());
    PairDigest found;
    find_in(scene, options, found);
    EXPECT_EQ(found, exact_digest(scene)) << step;
  }
}

TEST(HalfShellWraps, SeamsOfEveryAxisAreCrossed) {
  // A line of touching spheres along each axis, longer than a period of a coarse numbering.
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Sphere> spheres;
    for (int k = 0; k < 6000; ++k) {
      Sphere s = {0.0F, 0.0F, 0.0F, 0.5F};
      (axis == 0 ? s.x : axis == 1 ? s.y : s.z) = static_cast<float>(k);
      spheres.push_back(s);
    }
    spheres.push_back({4e6F, 4e6F, 4e6F, 0.5F});
    PairDigest found;
    find_in({spheres}, {.method = Method::half_shell}, found);
    EXPECT_EQ(found.count, 5999U) << axis;
    EXPECT_EQ(found, exact_digest({spheres})) << axis;
  }
}

/// Eight at a time, and those left over, also where they lie beyond the grid's box.
TEST(HalfShellColumns, AreWhatTheCellFormulaSays) {
  Scene scene = generate("gas:n=1003");
  std::mt19937 random(11);
  PlanFacts facts = measure(scene.view()).facts;
  for (Sphere& s : scene.spheres) {
    for (float* x : {&s.x, &s.y, &s.z}) {
      const float choices[] = {*x, -*x, *x * 1e30F, -*x * 1e30F, *x * 1e-40F, -1e-45F, kFloatMax};
      if (random() % 2 == 0) *x = choices[random() % std::size(choices)];
    }
  }
  for (const int bits : {9, 28}) {
    const auto w = workspace_for(scene.view(), {.method = Method::half_shell});
    Level& level = w->plan.levels.level[0];
    level = make_level(facts, facts.r_max, 2.5 * facts.r_max, 3, bits);
    level.first_id = 77;
    w->plan.levels.count = 1;
    half_shell::cell_ids(*w);
    for (std::size_t k = 0; k < scene.spheres.size(); ++k) {
      const Sphere& s = scene.spheres[k];
      ASSERT_EQ(w->ids[0].cell_ids[k], 77 + cell_id(level.grid, cell_of(level.grid, s.x, s.y, s.z)))
          << k;
    }
  }
}

/// Rows of 32: one begins with sphere 16384, as a block of stage 4 does.
TEST(HalfShellRows, MayBeginWhereABlockDoes) {
  static_assert(half_shell::IndexBlocks::kSpheres % 32 == 0 &&
                half_shell::IndexBlocks::kSpheres < 32768);
  const Scene scene = generate("lattice:n=32768,shuffle=1");
  const PairDigest truth = exact_digest(scene.view());
  for (const int threads : {1, 3}) {
    const Plan planned = roomy_plan(scene, {.method = Method::half_shell, .threads = threads});
    const Cut rows_of_32 = {.levels = 1, .columns = 1, .diameters = 1.0, .most_bits = 28};
    const Plan plan = with_levels(planned, scene, rows_of_32);
    ASSERT_EQ(plan.levels.level[0].grid.period(0), 32U);
    EXPECT_EQ(ask(*make_backend(), plan, scene.view()).digest, truth) << threads << " threads";
  }
}

TEST(HalfShellRows, HoldEveryPairOnceHoweverTheyAreCut) {
  bool wrapped[3] = {};
  const Scene scenes[] = {
      generate("poly:n=600"),      generate("dense:n=900"), generate("lattice:n=1000,shuffle=1"),
      generate("discs:n=600"),     generate("gas:n=9000"),  far_apart("poly:n=600", 1e4F),
      far_apart("gas:n=300", 1e7F)};
  for (std::size_t number = 0; number < std::size(scenes); ++number) {
    const Scene& scene = scenes[number];
    const PairDigest truth = exact_digest(scene.view());
    const Plan planned = roomy_plan(scene, {.method = Method::half_shell});
    for (const std::size_t levels : {1, 3}) {
      for (const std::uint32_t columns : {1, 3, 16}) {
        for (const double diameters : {1.0, 1.9, 5.0}) {
          for (const int bits : {12, 28}) {
            const Plan plan = with_levels(planned, scene, {levels, columns, diameters, bits});
            const FinderAnswer answer = ask_until_it_fits(*make_backend(), plan, scene.view());
            EXPECT_EQ(answer.digest, truth)
                << fmt::format("scene {}, {} levels, {} columns, {} diameters, {} bits", number,
                               levels, columns, diameters, bits);
            for (int a = 0; a < 3; ++a) wrapped[a] |= plan.levels.level[0].grid.wraps(a);
          }
        }
      }
    }
  }
  EXPECT_TRUE(wrapped[0] && wrapped[1] && wrapped[2]);
}

/// Two rows of spheres that touch in pairs across a border, more than are listed at once.
TEST(HalfShellRows, MayHoldMoreSpheresNearABorderThanAreListedAtOnce) {
  std::vector<Sphere> spheres;
  for (int k = 0; k < 10000; ++k) {
    const float x = 2.0F * static_cast<float>(k / 100) / 100.0F;  // crowds of a hundred pairs
    const float far = 40.0F * static_cast<float>(k % 100);
    spheres.push_back({x + far, 3.75F, 0.0F, 0.5F});
    spheres.push_back({x + far, 4.75F, 0.0F, 0.5F});
  }
  spheres.push_back({0.0F, 40.0F, 40.0F, 0.5F});
  spheres.push_back({0.0F, 0.0F, 0.0F, 0.5F});
  Scene scene;
  scene.spheres = spheres;
  const Plan planned = roomy_plan(scene, {.method = Method::half_shell});
  const Plan plan = with_levels(planned, scene, {1, 1, 4.0, 28});
  const Grid& grid = plan.levels.level[0].grid;
  ASSERT_NE(cell_coordinate(grid, 1, 3.75F), cell_coordinate(grid, 1, 4.75F));
  EXPECT_EQ(ask_until_it_fits(*make_backend(), plan, scene.view()).digest,
            exact_digest(scene.view()));
}

TEST(HalfShellWork, GrowsWithSpheresAndPairs) {
  for (const char* spec : {"gas:n=50000", "dense:n=50000", "poly:n=50000", "poly:n=50000,ratio=1e6",
                           "cluster:n=50000", "giant:n=50000", "discs:n=50000", "chain:n=50000",
                           "lattice:n=50000", "shifted:n=50000,offset=1e7"}) {
    const Scene scene = generate(spec);
    PairDigest found;
    const Outcome outcome = find_in(scene.view(), {.method = Method::half_shell}, found);
    // Sixteen lanes are looked at together.
    EXPECT_LE(outcome.counts.candidates, 200 * (scene.spheres.size() + found.count)) << spec;
  }
}

TEST(HalfShellWork, StopsAtTheLimitOfCandidates) {
  const Scene scene = generate("identical:n=20000");
  const auto finder = make_backend();
  const Outcome outcome = find_completely(
      *finder, scene.view(), {.method = Method::half_shell, .candidate_limit = 1000000});
  EXPECT_TRUE(outcome.counts.over_candidate_limit);
  EXPECT_LT(outcome.counts.candidates, 20000ULL * 19999 / 2);
}

TEST(HalfShellSkips, IdsThatComeInOrderAreNotSorted) {
  PairDigest found;
  const auto used = [&](const char* spec, Skips allowed) {
    return find_in(generate(spec).view(), {.method = Method::half_shell, .allowed = allowed}, found)
        .counts.used;
  };
  EXPECT_TRUE(used("chain:n=20000", Skips::all()).has(Skip::sort));
  EXPECT_FALSE(used("chain:n=20000", Skips::all().without(Skip::sort)).has(Skip::sort));
  EXPECT_FALSE(used("gas:n=20000", Skips::all()).has(Skip::sort));
}

/// A chain in order, and once more: each block of stage 2 is in order, the whole is not.
TEST(HalfShellSkips, IdsInOrderWithinBlocksAloneAreSorted) {
  Scene scene = generate("chain:n=4096");
  PairDigest found;
  const PlanOptions options = {.method = Method::half_shell};
  EXPECT_TRUE(find_in(scene.view(), options, found).counts.used.has(Skip::sort));
  const std::vector<Sphere> once = scene.spheres;
  scene.spheres.insert(scene.spheres.end(), once.begin(), once.end());
  EXPECT_FALSE(find_in(scene.view(), options, found).counts.used.has(Skip::sort));
  EXPECT_EQ(found, exact_digest(scene.view()));
}

TEST(RowCursor, FindsWhatALinearSearchFinds) {
  using half_shell::RowCursor;
  std::mt19937 random(7);
  std::vector<ColumnRow> rows;
  std::uint32_t id = 0;
  for (std::uint32_t k = 0; k < 500; ++k) {
    id += 1 + static_cast<std::uint32_t>(random() % 9);
    rows.push_back({id, k});
  }
  rows.push_back({~0U, 500});
  RowCursor cursor(rows.data(), rows.data() + 500);
  for (int k = 0; k < 20000; ++k) {
    const std::uint64_t wanted = random() % (id + 10);
    const ColumnRow* expected = rows.data();
    while (expected != rows.data() + 500 && expected->first_id < wanted) ++expected;
    ASSERT_EQ(cursor.not_before(wanted), expected) << wanted;
  }
}

}  // namespace
}  // namespace octocell::cpu
