// SPDX-License-Identifier: MIT
// How the two kernels of method tiles divide their shared memory. Plain arithmetic, which tests on
// the host call.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/host_device.hpp"
#include "core/tiles.hpp"

namespace octocell::cuda_custom::tiles {

/// A block that distributes spheres takes up to this many at a time. More of them share a tile, so
/// what it writes there is longer.
inline constexpr int kPartitionThreads = 1024;
inline constexpr int kSpheresPerThread = 8;
inline constexpr std::uint32_t kMostChunk = kPartitionThreads * kSpheresPerThread;

/// The block that searches a tile.
inline constexpr int kFindThreads = 512;
inline constexpr int kFindWarps = kFindThreads / 32;
inline constexpr int kRecordsPerThread = static_cast<int>(kMostTileRecords) / kFindThreads;
static_assert(kRecordsPerThread * kFindThreads == static_cast<int>(kMostTileRecords));
inline constexpr std::uint32_t kQueued = 192;  // candidates of 32 spheres
inline constexpr std::uint32_t kHits = 96;     // of a warp, before they are written

/// Bytes that a kernel has beside its dynamic shared memory: its own small arrays, and what the
/// system takes.
inline constexpr std::uint32_t kStaticBytes = 2048;

/// Where a block stages records in the order of their tiles, before it writes them in runs.
struct PartitionLayout {
  std::uint32_t tiles;
  std::uint32_t staged;  // records; any further ones are written one by one

  static constexpr std::uint32_t kBytesPerTile = 2 * sizeof(std::uint32_t);
  static constexpr std::uint32_t kBytesPerRecord = sizeof(TileRecord) + sizeof(std::uint16_t);

  [[nodiscard]] OCTOCELL_HD std::uint32_t tile_words_at() const {
    return staged * static_cast<std::uint32_t>(sizeof(TileRecord));
  }
  [[nodiscard]] OCTOCELL_HD std::uint32_t tile_numbers_at() const {
    return tile_words_at() + tiles * kBytesPerTile;
  }
  [[nodiscard]] OCTOCELL_HD std::uint32_t bytes() const {
    return tile_numbers_at() + staged * static_cast<std::uint32_t>(sizeof(std::uint16_t));
  }
};

/// Returns a layout for chunks of that size, with room for the copies of evenly spread spheres as
/// far as shared memory has it. `shared_bytes` is what a block may have at most.
inline PartitionLayout partition_layout(std::uint32_t tiles, std::uint32_t chunk,
                                        std::uint32_t shared_bytes) {
  const std::uint32_t taken = tiles * PartitionLayout::kBytesPerTile + kStaticBytes;
  const std::uint32_t left = shared_bytes > taken ? shared_bytes - taken : 0;
  const std::uint32_t most = left / PartitionLayout::kBytesPerRecord / 8 * 8;
  const std::uint32_t wanted = (chunk + chunk / 2 + 7) / 8 * 8;
  return {tiles, std::min(wanted, most)};
}

/// A tile's records in the order of their cells, where each cell begins, and what warps queue.
struct TileLayout {
  std::uint32_t room;   // records
  std::uint32_t cells;  // of a tile

  /// Returns the number of words of starts: two 16-bit starts each, one more than there are cells.
  [[nodiscard]] OCTOCELL_HD std::uint32_t start_words() const { return cells / 2 + 1; }
  [[nodiscard]] OCTOCELL_HD std::uint32_t starts_at() const {
    return room * static_cast<std::uint32_t>(sizeof(TileRecord));
  }
  [[nodiscard]] OCTOCELL_HD std::uint32_t queues_at() const {
    return starts_at() + start_words() * static_cast<std::uint32_t>(sizeof(std::uint32_t));
  }
  [[nodiscard]] OCTOCELL_HD std::uint32_t hits_at() const {
    return queues_at() + kFindWarps * kQueued * static_cast<std::uint32_t>(sizeof(std::uint32_t));
  }
  [[nodiscard]] OCTOCELL_HD std::uint32_t numbers_at() const {
    return hits_at() + kFindWarps * kHits * static_cast<std::uint32_t>(sizeof(std::uint32_t));
  }
  [[nodiscard]] OCTOCELL_HD std::uint32_t bytes() const {
    return numbers_at() + room * static_cast<std::uint32_t>(sizeof(std::uint16_t));
  }
};

/// From the number of a cell in its tile back to the cell. Numbers and divisors are below 2^16, so
/// a product with ceil(2^32 / m) has floor(number / m) in its upper half. Needs m >= 2.
struct CellNumbers {
  std::uint32_t row;    // cells
  std::uint32_t layer;  // cells
  std::uint32_t row_reciprocal;
  std::uint32_t layer_reciprocal;

  [[nodiscard]] OCTOCELL_HD Cell cell(std::uint32_t number) const {
    const std::uint32_t z = upper_half(number, layer_reciprocal);
    const std::uint32_t in_layer = number - z * layer;
    const std::uint32_t y = upper_half(in_layer, row_reciprocal);
    return {in_layer - y * row, y, z};
  }

 private:
  OCTOCELL_HD static std::uint32_t upper_half(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint32_t>((std::uint64_t{a} * b) >> 32);
  }
};
inline CellNumbers cell_numbers(const Tiles& tiles) {
  const auto reciprocal = [](std::uint32_t m) {
    return static_cast<std::uint32_t>(((std::uint64_t{1} << 32) + m - 1) / m);
  };
  const std::uint32_t row = tiles.width[0].units + 1;
  const std::uint32_t layer = row * (tiles.width[1].units + 1);
  return {row, layer, reciprocal(row), reciprocal(layer)};
}

}  // namespace octocell::cuda_custom::tiles
