// SPDX-License-Identifier: MIT
// How large are the tiles of method tiles? Large tiles have few copies; but a tile must fit into
// the shared memory of a thread block, and there must be enough of them for all blocks of a GPU.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/planner/planner.hpp"

namespace octocell {
namespace {

/// Tiles with more spheres leave room for one block a multiprocessor only, where there were two.
constexpr double kMostWanted = 2200.0;
/// A tile with fewer spheres spends its time on empty cells.
constexpr double kLeastWanted = 256.0;
/// Keeps all multiprocessors of a large GPU busy.
constexpr double kTilesWanted = 220.0;

double spheres_wanted(double spheres) {
  return std::clamp(spheres / kTilesWanted, kLeastWanted, kMostWanted);
}

/// Cuts the grid evenly into tiles of at most `edge` cells along each axis.
Tiles cut(const Grid& grid, std::uint32_t edge) {
  Tiles tiles;
  tiles.grid = grid;
  for (int a = 0; a < 3; ++a) {
    const std::uint32_t cells = grid.cell_count[a];
    const std::uint32_t parts = (cells - 1) / edge + 1;
    tiles.width[a] = cell_width((cells - 1) / parts + 1);
    tiles.count[a] = (cells - 1) / tiles.width[a].units + 1;
  }
  return tiles;
}

double tile_count(const Tiles& tiles) {
  return static_cast<double>(tiles.count[0]) * tiles.count[1] * tiles.count[2];
}

double cells_of_tile(const Tiles& tiles) {
  double cells = 1.0;
  for (const CellWidth& width : tiles.width) cells *= width.units + 1.0;
  return cells;
}

/// Returns how many spheres and copies a tile gets if the spheres are spread evenly.
double expected_records(const Tiles& tiles, double spheres) {
  double part = 1.0;
  for (int a = 0; a < 3; ++a) {
    const double cells = tiles.grid.cell_count[a];
    part *= std::min(tiles.width[a].units + 1.0, cells) / cells;
  }
  return spheres * part;
}

/// Returns the largest tiles that have no more than `most` spheres and copies, or the smallest
/// there are.
Tiles largest_tiles(const Grid& grid, double spheres, double most) {
  Tiles best = cut(grid, 1);
  for (std::uint32_t edge = 2; tile_count(best) > 1.0; ++edge) {
    const Tiles tiles = cut(grid, edge);
    if (cells_of_tile(tiles) > kMostTileCells || expected_records(tiles, spheres) > most) break;
    best = tiles;
  }
  return best;
}

/// Returns true if larger cells would give better tiles: there are too many tiles, or a tile has
/// few spheres although it has about as many cells as it can.
bool have_too_small_cells(const Tiles& tiles, double spheres, double wanted) {
  const double count = tile_count(tiles);
  if (count == 1.0) return false;
  const bool many_cells = cells_of_tile(tiles) > kMostTileCells / 8.0;
  return count > kMostTiles || (many_cells && spheres / count < wanted / 2.0);
}

}  // namespace

Tiles make_tiles(const SceneStats& stats) {
  const PlanFacts& facts = stats.facts;
  const auto spheres = static_cast<double>(facts.sphere_count);
  const double wanted = spheres_wanted(spheres);
  double side = 2.0 * static_cast<double>(facts.r_max);
  if (side == 0.0) side = std::max(mean_spacing(facts) / 2.0, 0x1p-149);
  Tiles tiles;
  do {
    const Level level = make_level(facts, facts.r_max, side, 1, kMaxKeyBits);
    tiles = largest_tiles(level.grid, spheres, 1.15 * wanted);
    side = std::cbrt(2.0) * std::max(side, level.grid.cell_side);
  } while (have_too_small_cells(tiles, spheres, wanted));
  tiles.equal_radii = facts.r_min == facts.r_max;
  return tiles;
}

std::uint32_t tile_room(const Tiles& tiles, std::uint64_t spheres) {
  constexpr double kDeviations = 6.2;  // of a Poisson distribution
  const double expected = expected_records(tiles, static_cast<double>(spheres));
  const double room = expected + kDeviations * std::sqrt(expected) + 40.0;
  const double most = std::min(room, static_cast<double>(spheres));
  return std::min(static_cast<std::uint32_t>(std::min(most, 1e9)) / 8 * 8 + 8, kMostTileRecords);
}

}  // namespace octocell
