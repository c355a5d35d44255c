// SPDX-License-Identifier: MIT
// Method tiles without a GPU: the plan's arithmetic, and both kernels' logic with the functions
// that they share, one sphere after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/overlap.hpp"
#include "core/planner/planner.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cuda_custom/tiles/tile_layout.hpp"

namespace octocell {
namespace {

using cuda_custom::tiles::cell_numbers;
using cuda_custom::tiles::CellNumbers;
using cuda_custom::tiles::PartitionLayout;
using cuda_custom::tiles::TileLayout;

constexpr std::uint32_t kSharedOfH100 = 232448;  // bytes that a block may have

using Contents = std::vector<std::vector<TileRecord>>;  // of each tile

Contents distributed(const Tiles& tiles, const std::vector<Sphere>& spheres) {
  Contents contents(tiles.tile_count());
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const Sphere& s = spheres[i];
    const TilesMet met = tiles_met(tiles, cell_of(tiles.grid, s.x, s.y, s.z));
    for_each_tile(tiles, met, [&](std::uint32_t tile) {
      contents.at(tile).push_back({s.x, s.y, s.z, i});
    });
  }
  return contents;
}

/// Sorts the records by cell, by counting. Returns where each cell begins.
std::vector<std::uint32_t> sort_by_cell(const Tiles& tiles, std::uint32_t tile,
                                        std::vector<TileRecord>& records) {
  const Cell first = first_cell_of(tiles, tile);
  const auto number = [&](const TileRecord& r) {
    return number_in_tile(tiles, cell_in_tile(tiles, first, r));
  };
  std::vector<std::uint32_t> starts(tiles.cells_of_tile() + 1);
  for (const TileRecord& r : records) ++starts.at(number(r) + 1);
  for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
  std::ranges::stable_sort(records, {}, number);
  return starts;
}

/// Calls visit(a, b) for each pair of records that the tile tests.
template <typename Visit>
void for_each_test(const Tiles& tiles, std::uint32_t tile, std::vector<TileRecord> records,
                   Visit visit) {
  const std::vector<std::uint32_t> starts = sort_by_cell(tiles, tile, records);
  const CellNumbers numbers = cell_numbers(tiles);
  const Cell first = first_cell_of(tiles, tile);
  for (std::uint32_t row = 0; row < records.size(); ++row) {
    const std::uint32_t own = number_in_tile(tiles, cell_in_tile(tiles, first, records[row]));
    for (int k = 0; k < kRunsInTile; ++k) {
      const CellRun run = run_in_tile(tiles, numbers.cell(own), k);
      if (run.begin == run.end) continue;
      const std::uint32_t begin = k == 0 ? row + 1 : starts.at(run.begin);
      for (std::uint32_t other = begin; other < starts.at(run.end); ++other) {
        visit(records[row], records[other]);
      }
    }
  }
}

std::vector<Pair> pairs_of(const Tiles& tiles, const std::vector<Sphere>& spheres) {
  std::vector<Pair> pairs;
  const Contents contents = distributed(tiles, spheres);
  for (std::uint32_t tile = 0; tile < contents.size(); ++tile) {
    for_each_test(tiles, tile, contents[tile], [&](const TileRecord& a, const TileRecord& b) {
      if (overlap_exact(spheres[a.id], spheres[b.id])) pairs.push_back(make_pair_of(a.id, b.id));
    });
  }
  std::ranges::sort(pairs);
  return pairs;
}

/// Cuts the cells into tiles of those widths.
Tiles with_widths(Tiles tiles, const std::uint32_t (&widths)[3]) {
  for (int a = 0; a < 3; ++a) {
    tiles.width[a] = cell_width(widths[a]);
    tiles.count[a] = (tiles.grid.cell_count[a] - 1) / widths[a] + 1;
  }
  return tiles;
}

constexpr std::uint32_t kWidths[][3] = {{1, 1, 1}, {2, 2, 2}, {3, 1, 2}, {5, 4, 7}, {1, 9, 1}};

/// Two spheres in the middle of each cell.
std::vector<Sphere> two_a_cell(const std::uint32_t (&cells)[3]) {
  std::vector<Sphere> spheres;
  for (std::uint32_t z = 0; z < cells[2]; ++z) {
    for (std::uint32_t y = 0; y < cells[1]; ++y) {
      for (std::uint32_t x = 0; x < cells[0]; ++x) {
        const Sphere s = {static_cast<float>(x) - 3.5F, static_cast<float>(y) - 2.5F,
                          static_cast<float>(z) - 1.5F, 0.5F};
        spheres.insert(spheres.end(), 2, s);
      }
    }
  }
  return spheres;
}

/// All pairs of spheres in the same or in adjacent cells are tested once, and no others.
TEST(Tiles, EachPairOfAdjacentCellsIsTestedOnce) {
  const std::uint32_t cells[3] = {9, 7, 5};
  const std::vector<Sphere> spheres = two_a_cell(cells);
  Tiles whole;
  whole.grid = make_level(measure({spheres}).facts, 0.5F, 1.0, 1, kMaxKeyBits).grid;
  for (int a = 0; a < 3; ++a) ASSERT_EQ(whole.grid.cell_count[a], cells[a]);
  for (const auto& widths : kWidths) {
    const Tiles tiles = with_widths(whole, widths);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> tests;
    const Contents contents = distributed(tiles, spheres);
    for (std::uint32_t tile = 0; tile < contents.size(); ++tile) {
      for_each_test(tiles, tile, contents[tile], [&](const TileRecord& a, const TileRecord& b) {
        ++tests[std::minmax(a.id, b.id)];
      });
    }
    std::size_t adjacent = 0;
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
      for (std::uint32_t j = i + 1; j < spheres.size(); ++j) {
        const Sphere& a = spheres[i];
        const Sphere& b = spheres[j];
        const float apart =
            std::max({std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z)});
        if (apart > 1.0F) continue;
        ++adjacent;
        const auto found = tests.find({i, j});
        EXPECT_EQ(found == tests.end() ? 0 : found->second, 1) << i << ", " << j;
      }
    }
    EXPECT_EQ(tests.size(), adjacent) << widths[0] << widths[1] << widths[2];
  }
}

std::vector<Sphere> moved(std::vector<Sphere> spheres, float by) {
  for (Sphere& s : spheres) {
    s.x += by;
    s.y -= by;
    s.z += by / 2;
  }
  return spheres;
}

void expect_the_exact_pairs(const std::vector<Sphere>& spheres, const std::string& name) {
  const Tiles planned = make_tiles(measure({spheres}));
  const std::vector<Pair> truth = reference::exact_pairs(spheres);
  EXPECT_EQ(pairs_of(planned, spheres), truth) << name;
  for (const auto& widths : kWidths) {
    const Tiles tiles = with_widths(planned, widths);
    if (tiles.tile_count() > 2'000'000) continue;
    EXPECT_EQ(pairs_of(tiles, spheres), truth)
        << name << ", " << widths[0] << " x " << widths[1] << " x " << widths[2];
  }
}

TEST(Tiles, FindTheExactPairs) {
  for (const char* spec :
       {"gas:n=1", "gas:n=2", "gas:n=1500", "dense:n=1500", "poly:n=1500", "cluster:n=1500",
        "lattice:n=1331", "shifted:n=1500", "discs:n=1500", "chain:n=900", "identical:n=200"}) {
    expect_the_exact_pairs(generate(spec).spheres, spec);
  }
}

/// Far from the origin, cells are as coarse as float32 there.
TEST(Tiles, FindTheExactPairsFarAwayAndBelowZero) {
  for (const float by : {-17.25F, 1e4F, -1e6F, 1e9F, 3e18F}) {
    expect_the_exact_pairs(moved(generate("gas:n=800").spheres, by),
                           "gas by " + std::to_string(by));
    expect_the_exact_pairs(moved(generate("lattice:n=512").spheres, by),
                           "lattice by " + std::to_string(by));
  }
}

TEST(Tiles, FindTheExactPairsOfPointsAndOfHugeSpheres) {
  std::vector<Sphere> points = generate("gas:n=800").spheres;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].r = 0.0F;
    if (i % 5 == 0) points[i] = points[0];
  }
  expect_the_exact_pairs(points, "points");
  std::vector<Sphere> huge = generate("gas:n=200").spheres;
  huge[7] = {3e38F, -3e38F, 0.0F, 1e38F};
  huge[9] = {2.5e38F, -3e38F, 0.0F, 3e38F};
  expect_the_exact_pairs(huge, "huge");
}

/// Any box is right: what lies outside belongs to border cells.
TEST(Tiles, FindTheExactPairsWithTheGridOverAPart) {
  const std::vector<Sphere> spheres = generate("gas:n=1500").spheres;
  SceneStats part = measure({spheres});
  for (int a = 0; a < 3; ++a) {
    part.facts.lowest[a] = 0.7F * part.facts.lowest[a] + 0.3F * part.facts.highest[a];
  }
  const Tiles planned = make_tiles(part);
  for (const auto& widths : kWidths) {
    EXPECT_EQ(pairs_of(with_widths(planned, widths), spheres), reference::exact_pairs(spheres));
  }
}

SceneStats stats_of(std::uint64_t count, float box, float r) {
  SceneStats stats;
  stats.facts.sphere_count = count;
  for (float& end : stats.facts.highest) end = box;
  stats.facts.r_max = stats.facts.r_min = stats.facts.r_min_nonzero = r;
  return stats;
}

TEST(Tiles, PlansFitIntoAThreadBlock) {
  for (const std::uint64_t count : {1ULL, 100ULL, 10'000ULL, 1'000'000ULL, 30'000'000ULL}) {
    for (const float box : {1e-3F, 1.0F, 300.0F, 1e5F, 1e20F}) {
      for (const float r : {0.0F, 1e-30F, 0.5F, 1e4F}) {
        const Tiles tiles = make_tiles(stats_of(count, box, r));
        EXPECT_GE(tiles.grid.cell_side, 2.0 * r);
        EXPECT_LE(tiles.tile_count(), kMostTiles);
        EXPECT_LE(tiles.cells_of_tile(), kMostTileCells);
        for (int a = 0; a < 3; ++a) {
          EXPECT_GE(tiles.count[a] * tiles.width[a].units, tiles.grid.cell_count[a]);
          EXPECT_LT((tiles.count[a] - 1) * tiles.width[a].units, tiles.grid.cell_count[a]);
        }
        const std::uint32_t room = tile_room(tiles, count);
        EXPECT_LE(room, kMostTileRecords);
        const TileLayout layout = {room, tiles.cells_of_tile()};
        EXPECT_LE(layout.bytes() + cuda_custom::tiles::kStaticBytes, kSharedOfH100);
      }
    }
  }
}

/// The gas of the benchmarks: tiles as full as they should be, and few of them over the room.
TEST(Tiles, HaveRoomForAGas) {
  const std::vector<Sphere> spheres = generate("gas:n=200000").spheres;
  const Tiles tiles = make_tiles(measure({spheres}));
  EXPECT_TRUE(tiles.equal_radii);
  EXPECT_GT(tiles.tile_count(), 100U);
  EXPECT_LT(tiles.tile_count(), 800U);
  std::size_t most = 0;
  std::size_t records = 0;
  for (const auto& tile : distributed(tiles, spheres)) {
    most = std::max(most, tile.size());
    records += tile.size();
  }
  EXPECT_LE(most, tile_room(tiles, spheres.size()));
  EXPECT_GT(2 * most, tile_room(tiles, spheres.size()));
  EXPECT_LT(static_cast<double>(records), 1.5 * static_cast<double>(spheres.size()));
}

TEST(Tiles, SharedMemoryIsDividedInOrder) {
  for (const std::uint32_t room : {0U, 8U, 2984U, kMostTileRecords}) {
    for (const std::uint32_t cells : {8U, 27U, 13824U, kMostTileCells}) {
      const TileLayout layout = {room, cells};
      EXPECT_EQ(layout.starts_at(), 16 * room);
      EXPECT_GE(layout.queues_at(), layout.starts_at() + 2 * (cells + 1));
      EXPECT_GT(layout.hits_at(), layout.queues_at());
      EXPECT_GT(layout.numbers_at(), layout.hits_at());
      EXPECT_EQ(layout.bytes(), layout.numbers_at() + 2 * room);
      EXPECT_EQ(layout.hits_at() % 4, 0U);
      EXPECT_LE(layout.bytes() + cuda_custom::tiles::kStaticBytes, kSharedOfH100);
    }
  }
  for (const std::uint32_t tiles : {1U, 264U, 4096U, kMostTiles}) {
    for (const std::uint32_t chunk : {256U, 1024U, cuda_custom::tiles::kMostChunk}) {
      const PartitionLayout layout =
          cuda_custom::tiles::partition_layout(tiles, chunk, kSharedOfH100);
      EXPECT_LE(layout.bytes() + cuda_custom::tiles::kStaticBytes, kSharedOfH100);
      EXPECT_GT(layout.staged, 0U);
      EXPECT_LE(layout.staged, 65536U);
    }
  }
}

TEST(Tiles, CellNumbersComeBackAsCells) {
  for (const auto& [x, y, z] : {std::array{1U, 1U, 1U},
                                {23U, 23U, 23U},
                                {3582U, 1U, 1U},
                                {1U, 3582U, 1U},
                                {1U, 1U, 3582U},
                                {7U, 40U, 42U}}) {
    Tiles tiles;
    tiles.width[0] = cell_width(x);
    tiles.width[1] = cell_width(y);
    tiles.width[2] = cell_width(z);
    ASSERT_LE(tiles.cells_of_tile(), kMostTileCells);
    const CellNumbers numbers = cell_numbers(tiles);
    for (std::uint32_t n = 0; n < tiles.cells_of_tile(); ++n) {
      ASSERT_EQ(number_in_tile(tiles, numbers.cell(n)), n);
      ASSERT_LE(numbers.cell(n).x, x);
      ASSERT_LE(numbers.cell(n).y, y);
    }
  }
}

TEST(Tiles, TileCoordinatesAreQuotients) {
  for (const std::uint32_t width : {1U, 2U, 3U, 22U, 255U, 257U, 3582U}) {
    Tiles tiles;
    tiles.width[0] = cell_width(width);
    for (std::uint32_t cell = 0; cell < 1U << 30; cell += cell < 20'000 ? 1 : 10'007) {
      ASSERT_EQ(tile_coordinate(tiles, 0, cell), cell / width);
    }
  }
}

TEST(Tiles, ATileThatIsTooFullGetsMoreRoomOrHalfShell) {
  const Scene scene = generate("gas:n=5000");
  const Plan plan = make_plan(measure(scene.view()), {.method = Method::tiles});
  EXPECT_EQ(plan.method, Method::tiles);
  EXPECT_EQ(plan.facts.r_min, plan.facts.r_max);  // so that stage 1 checks that radii are equal
  Counts found;
  found.tile_records = plan.capacity.tile_records + 1;
  EXPECT_FALSE(fits(found, plan.capacity, false));
  const Plan roomier = grow(plan, found);
  EXPECT_EQ(roomier.method, Method::tiles);
  EXPECT_EQ(roomier.capacity.tile_records, found.tile_records);
  found.tile_records = kMostTileRecords + 1;
  const Plan other = grow(plan, found);
  EXPECT_EQ(other.method, Method::half_shell);
  EXPECT_GT(other.levels.count, 0);
  EXPECT_TRUE(other.taken.has(Skip::key_bits));
}

}  // namespace
}  // namespace octocell
