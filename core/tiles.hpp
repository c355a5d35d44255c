// SPDX-License-Identifier: MIT
// Method tiles: boxes of cells, each small enough for the shared memory of one thread block.
//
// A sphere belongs to the tile of its cell. If its cell is the first of the tile along an axis, a
// copy goes to the tile before, where it lies one cell behind the last. A pair is tested in the
// tile of its lowest common cell: on each axis, the lower of the two cells. That tile has both
// spheres, as their cells differ by at most one (docs/exactness.md, "Tiles"). The kernels and the
// tests on the host share the functions of this file, so there is one cell expression.
#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell {

/// What a thread block has room for. Positions in a tile are 16-bit numbers, and a table has one
/// for each cell; the block that distributes spheres has two words for each tile.
inline constexpr std::uint32_t kMostTileRecords = 4096;
inline constexpr std::uint32_t kMostTileCells = 14336;
inline constexpr std::uint32_t kMostTiles = 16000;

struct Tiles {
  Grid grid;                           // its cells are at least 2 r_max wide; its ids are not used
  CellWidth width[3];                  // of a tile, in cells
  std::uint32_t count[3] = {1, 1, 1};  // of tiles along each axis
  bool equal_radii = false;            // then a record needs no radius

  [[nodiscard]] OCTOCELL_HD std::uint32_t tile_count() const {
    return count[0] * count[1] * count[2];
  }
  /// Returns the number of cells that a tile's spheres may lie in, those of copies included.
  [[nodiscard]] OCTOCELL_HD std::uint32_t cells_of_tile() const {
    return (width[0].units + 1) * (width[1].units + 1) * (width[2].units + 1);
  }
};

/// A sphere without its radius, as a tile holds it.
struct alignas(16) TileRecord {
  float x;
  float y;
  float z;
  std::uint32_t id;
};

/// Returns the tile that holds a cell, along one axis.
OCTOCELL_HD std::uint32_t tile_coordinate(const Tiles& tiles, int axis, std::uint32_t cell) {
  const CellWidth& width = tiles.width[axis];
  return static_cast<std::uint32_t>((cell * width.reciprocal) >> width.reciprocal_bits);
}

/// The tiles that a sphere is put into: its own, and the one before along each axis in `before`.
struct TilesMet {
  std::uint32_t own;     // index of the tile
  std::uint32_t before;  // bit a: the cell is the first of its tile along axis a, and not of all
};

OCTOCELL_HD TilesMet tiles_met(const Tiles& tiles, Cell cell) {
  const std::uint32_t x = tile_coordinate(tiles, 0, cell.x);
  const std::uint32_t y = tile_coordinate(tiles, 1, cell.y);
  const std::uint32_t z = tile_coordinate(tiles, 2, cell.z);
  const auto is_first = [&](int axis, std::uint32_t tile, std::uint32_t c) {
    return tile != 0 && c == tile * tiles.width[axis].units;
  };
  const std::uint32_t before = (is_first(0, x, cell.x) ? 1U : 0U) |
                               (is_first(1, y, cell.y) ? 2U : 0U) |
                               (is_first(2, z, cell.z) ? 4U : 0U);
  return {x + tiles.count[0] * (y + tiles.count[1] * z), before};
}

/// Calls visit(tile) for the sphere's own tile and for each tile with a copy of it.
template <typename Visit>
OCTOCELL_HD void for_each_tile(const Tiles& tiles, TilesMet met, Visit visit) {
  const std::uint32_t stride_y = tiles.count[0];
  const std::uint32_t stride_z = tiles.count[0] * tiles.count[1];
  std::uint32_t axes = met.before;
  for (;;) {  // all subsets of met.before, the empty one last
    visit(met.own - ((axes & 1) != 0 ? 1 : 0) - ((axes & 2) != 0 ? stride_y : 0) -
          ((axes & 4) != 0 ? stride_z : 0));
    if (axes == 0) return;
    axes = (axes - 1) & met.before;
  }
}

/// Returns the first cell of a tile.
OCTOCELL_HD Cell first_cell_of(const Tiles& tiles, std::uint32_t tile) {
  const std::uint32_t row = tile / tiles.count[0];
  const std::uint32_t layer = row / tiles.count[1];
  return {(tile - row * tiles.count[0]) * tiles.width[0].units,
          (row - layer * tiles.count[1]) * tiles.width[1].units, layer * tiles.width[2].units};
}

/// Numbers the cells of a tile, those of copies included.
OCTOCELL_HD std::uint32_t number_in_tile(const Tiles& tiles, Cell in_tile) {
  return in_tile.x +
         (tiles.width[0].units + 1) * (in_tile.y + (tiles.width[1].units + 1) * in_tile.z);
}

/// Returns a sphere's cell, counted from the first cell of the tile. Copies lie in cells whose
/// coordinate is the tile's width.
OCTOCELL_HD Cell cell_in_tile(const Tiles& tiles, Cell first, const TileRecord& record) {
  const Cell cell = cell_of(tiles.grid, record.x, record.y, record.z);
  return {cell.x - first.x, cell.y - first.y, cell.z - first.z};
}

/// Cells [begin, end) of a tile, by number.
struct CellRun {
  std::uint32_t begin;
  std::uint32_t end;
};

/// Half of the cells around a cell, in runs along x: the cell itself and the next; the three cells
/// of the next row; those of three rows in the next layer.
inline constexpr int kRunsInTile = 5;

/// Returns run number `run` of a cell. Leaves out cells that are not the tile's to test: on some
/// axis both cells would lie behind the tile, so their lowest common cell lies in another tile.
OCTOCELL_HD CellRun run_in_tile(const Tiles& tiles, Cell cell, int run) {
  const std::uint32_t behind_x = tiles.width[0].units;
  const std::uint32_t behind_y = tiles.width[1].units;
  const std::uint32_t behind_z = tiles.width[2].units;
  const std::uint32_t up = run >= 2 ? 1 : 0;                                         // layers
  const std::uint32_t row = cell.y + (run == 0 || run == 3 ? 1 : run == 2 ? 0 : 2);  // y + 1
  const std::uint32_t layer = cell.z + up;
  if (row == 0 || row > behind_y + 1 || layer > behind_z) return {0, 0};
  const std::uint32_t y = row - 1;
  if ((cell.y == behind_y && y == behind_y) || (cell.z == behind_z && layer == behind_z)) {
    return {0, 0};
  }
  if (run == 0) {
    if (cell.x == behind_x) return {0, 0};
    const std::uint32_t own = number_in_tile(tiles, cell);
    return {own, own + 2};
  }
  const std::uint32_t begin = cell.x == 0 ? 0 : cell.x - 1;
  const std::uint32_t end = cell.x == behind_x ? cell.x : cell.x + 2;
  const std::uint32_t first = number_in_tile(tiles, {0, y, layer});
  return {first + begin, first + end};
}

}  // namespace octocell
