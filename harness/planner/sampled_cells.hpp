// SPDX-License-Identifier: MIT
// How many spheres of a sample share a cell, or a block of cells? In Morton order (Morton 1966, A
// computer oriented geodetic data base) the cells of each block of 2^k a side follow each other:
// put in order once, the sample answers for blocks of all sizes.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "harness/interface/grid.hpp"
#include "harness/interface/sphere.hpp"

namespace octocell {

class SampledCells {
 public:
  /// `columns` of the grid, along x, make a cell.
  SampledCells(const Grid& grid, const std::vector<Sphere>& sample, std::uint32_t columns)
      : finest_(std::max(bits_of_coordinates(grid, columns) - kMortonBits, 0)) {
    codes_.reserve(sample.size());
    for (const Sphere& s : sample) {
      const Cell cell = cell_of(grid, s.x, s.y, s.z);
      codes_.push_back(spread((cell.x / columns) >> finest_) | spread(cell.y >> finest_) << 1 |
                       spread(cell.z >> finest_) << 2);
    }
    std::ranges::sort(codes_);
  }

  /// The smallest shift that pairs_in_blocks() can tell of.
  [[nodiscard]] int finest() const { return finest_; }

  /// Pairs of the sample that share a block of 2^shift cells a side.
  [[nodiscard]] std::uint64_t pairs_in_blocks(int shift) const {
    std::uint64_t pairs = 0;
    std::uint64_t alike = 0;
    for (std::size_t k = 1; k < codes_.size(); ++k) {
      alike = (codes_[k] ^ codes_[k - 1]) >> 3 * (shift - finest_) == 0 ? alike + 1 : 0;
      pairs += alike;
    }
    return pairs;
  }

 private:
  static constexpr int kMortonBits = 21;  // of each coordinate, three in a word

  /// Moves bit k of a coordinate to bit 3 k.
  static std::uint64_t spread(std::uint64_t bits) {
    bits = (bits | bits << 32) & 0x001f00000000ffffU;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffU;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fU;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3U;
    return (bits | bits << 2) & 0x1249249249249249U;
  }
  static int bits_of_coordinates(const Grid& grid, std::uint32_t columns) {
    return static_cast<int>(std::bit_width(
        std::max({grid.cell_count[0] / columns, grid.cell_count[1], grid.cell_count[2]})));
  }

  int finest_;
  std::vector<std::uint64_t> codes_;
};

}  // namespace octocell
