// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <set>

#include "core/as_written.hpp"
#include "harness/scenes/scenes.hpp"
#include "tests/support/cpu_pipeline.hpp"

namespace octocell::cpu {
namespace {

std::unique_ptr<Workspace> after_cell_ids(const Scene& scene, const PlanOptions& options) {
  auto w = workspace_for(scene.view(), options);
  bounds(*w);
  cell_ids(*w);
  EXPECT_FALSE(w->violation) << w->violation.value_or("");
  EXPECT_TRUE(w->ids_complete());
  return w;
}

/// Every cell of every sphere's box, straight from the definition.
std::multiset<std::pair<std::uint32_t, std::uint32_t>> expected_ids(const Workspace& w,
                                                                    float scale) {
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> expected;
  for (std::uint32_t i = 0; i < w.scene.spheres.size(); ++i) {
    const Sphere& s = w.scene.spheres[i];
    const auto [low, high] = cells_met(w.plan.grid, s, s.r * scale);
    for (std::uint32_t z = low.z; z <= high.z; ++z) {
      for (std::uint32_t y = low.y; y <= high.y; ++y) {
        for (std::uint32_t x = low.x; x <= high.x; ++x) {
          expected.emplace(cell_id(w.plan.grid, {x, y, z}), i);
        }
      }
    }
  }
  return expected;
}

std::multiset<std::pair<std::uint32_t, std::uint32_t>> listed_ids(const Workspace& w) {
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> listed;
  for (std::uint64_t k = 0; k < w.id_count; ++k) {
    listed.emplace(w.ids[0].cell_ids[k], w.ids[0].objects[k] & kIdMask);
  }
  return listed;
}

TEST(CellIds, ListEveryCellOfEverySphereOnce) {
  for (const char* spec : {"gas:n=1", "gas:n=2", "gas:n=4095", "gas:n=4096", "gas:n=4097",
                           "poly:n=5001", "giant:n=3000", "shifted:n=3000", "lattice:n=3000"}) {
    const Scene scene = generate(spec);
    for (const int threads : {1, 3}) {
      const auto w = after_cell_ids(scene, {.threads = threads});
      EXPECT_EQ(listed_ids(*w), expected_ids(*w, 1.0F)) << spec;
    }
  }
}

TEST(CellIds, OfChapter32CoverTheSphereScaledBySqrtTwo) {
  const Scene scene = generate("poly:n=5001");
  const auto w = after_cell_ids(scene, {.rule = Rule::chapter32});
  EXPECT_EQ(listed_ids(*w), expected_ids(*w, chapter32::kScale));
}

/// What claim C asks of the scale, for every significand; both squares are exact in float64.
TEST(CellIds, OfChapter32ReachNoLessThanRootTwo) {
  const auto square = [](float value) { return static_cast<double>(value) * value; };
  for (float r = 1.0F; r < 2.0F; r = std::nextafter(r, 2.0F)) {
    ASSERT_GE(square(chapter32::extent(r)), 2.0 * square(r)) << r;
  }
}

TEST(CellIds, HomesComeFirstInOrderAndAloneLackThePhantomBit) {
  const Scene scene = generate("gas:n=10001");
  const auto w = after_cell_ids(scene, {.threads = 2});
  ASSERT_GT(w->id_count, 10001U);
  for (std::uint32_t k = 0; k < w->id_count; ++k) {
    const Object object = w->ids[0].objects[k];
    ASSERT_EQ((object & kPhantom) == 0, k < 10001) << k;
    if (k >= 10001) continue;
    ASSERT_EQ(object & kIdMask, k);
    const Sphere& s = scene.spheres[k];
    ASSERT_EQ(w->ids[0].cell_ids[k], cell_id(w->plan.grid, cell_of(w->plan.grid, s.x, s.y, s.z)));
  }
}

TEST(CellIds, MarkOneEntryOfEachSphereAsLowestOnAllAxes) {
  const Scene scene = generate("giant:n=3000");
  const auto w = after_cell_ids(scene, {});
  std::map<std::uint32_t, int> lowest_corners;
  for (std::uint64_t k = 0; k < w->id_count; ++k) {
    const Object object = w->ids[0].objects[k];
    if ((object & kLowestMask) == kLowestMask) ++lowest_corners[object & kIdMask];
  }
  EXPECT_EQ(lowest_corners.size(), 3000U);
  for (const auto& [sphere, count] : lowest_corners) EXPECT_EQ(count, 1) << sphere;
}

TEST(CellIds, OfChapter32RecordTypesInControlBits) {
  const Scene scene = generate("gas:n=5000");
  const auto w = after_cell_ids(scene, {.rule = Rule::chapter32});
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const Sphere& s = scene.spheres[i];
    const Grid& grid = w->plan.grid;
    const auto [low, high] = cells_met(grid, s, chapter32::extent(s.r));
    std::uint32_t met = 0;
    for (std::uint32_t z = low.z; z <= high.z; ++z) {
      for (std::uint32_t y = low.y; y <= high.y; ++y) {
        for (std::uint32_t x = low.x; x <= high.x; ++x) {
          met |= 8U << ((x % 2) + 2 * (y % 2) + 4 * (z % 2));
        }
      }
    }
    ASSERT_EQ(w->control_bits[i], met | chapter32::cell_type(cell_of(grid, s.x, s.y, s.z))) << i;
  }
}

TEST(CellIds, AsWrittenListsAtMostEightAndSaturatesNegatives) {
  const Scene scene = generate("gas:n=5000");  // straddles the origin
  const auto w = after_cell_ids(scene, {.rule = Rule::as_written});
  std::map<std::uint32_t, int> listed;
  for (std::uint64_t k = 0; k < w->id_count; ++k) ++listed[w->ids[0].objects[k] & kIdMask];
  int most = 0;
  for (const auto& [sphere, count] : listed) most = std::max(most, count);
  EXPECT_EQ(most, 8);
  const Sphere negative = {-1.0F, -50.0F, -0.1F, 0.5F};
  EXPECT_EQ(as_written::hash(as_written::home(negative, 0.75F)), 0U);
}

TEST(CellIds, AFullBufferIsCountedToTheEnd) {
  const Scene scene = generate("gas:n=5000");
  const auto enough = after_cell_ids(scene, {});
  auto w = workspace_for(scene.view(), {});
  for (IdArrays& ids : w->ids) ids = IdArrays();
  w->plan.capacity.ids = 5001;
  w->allocate();
  bounds(*w);
  cell_ids(*w);
  EXPECT_FALSE(w->ids_complete());
  EXPECT_EQ(w->id_count, enough->id_count);
}

}  // namespace
}  // namespace octocell::cpu
