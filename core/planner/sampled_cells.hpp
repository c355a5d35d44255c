// SPDX-License-Identifier: MIT
// How many spheres of a sample share a cell, or a block of cells?  In Morton order (Morton 1966, A
// computer oriented geodetic data base) the cells of each block of 2^k a side follow one another.
// So the sample is sorted once and can then be counted for blocks of all sizes. If an axis has more
// cells than a third of a word can number, each code has a second word. One far sphere makes an
// axis that long, and then all other spheres differ in the lowest bits only.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid.hpp"
#include "core/sphere.hpp"

namespace octocell {

class SampledCells {
 public:
  /// `columns` columns of the grid, along x, make a cell.
  SampledCells(const Grid& grid, const std::vector<Sphere>& sample, std::uint32_t columns)
      : is_wide_(bits_of_coordinates(grid, columns) > kMortonBits) {
    is_wide_ ? wide_.reserve(sample.size()) : codes_.reserve(sample.size());
    for (const Sphere& s : sample) {
      Cell cell = cell_of(grid, s.x, s.y, s.z);
      cell.x /= columns;
      if (is_wide_) {
        wide_.push_back({code_of(cell, kMortonBits), code_of(cell, 0)});
      } else {
        codes_.push_back(code_of(cell, 0));
      }
    }
    std::ranges::sort(codes_);
    std::ranges::sort(wide_);
  }

  /// Returns how many pairs of the sample share a block of 2^shift cells a side.
  [[nodiscard]] std::uint64_t pairs_in_blocks(int shift) const {
    if (!is_wide_) {
      return count_alike(
          codes_, [&](std::uint64_t a, std::uint64_t b) { return (a ^ b) >> 3 * shift == 0; });
    }
    return count_alike(wide_, [&](const WideCode& a, const WideCode& b) {
      if (shift >= kMortonBits) return (a[0] ^ b[0]) >> 3 * (shift - kMortonBits) == 0;
      return a[0] == b[0] && (a[1] ^ b[1]) >> 3 * shift == 0;
    });
  }

 private:
  static constexpr int kMortonBits = 21;          // bits of each coordinate; a word holds three
  using WideCode = std::array<std::uint64_t, 2>;  // the highest bits first

  /// Counts pairs of equal codes; `codes` must be sorted.
  template <typename Codes, typename Alike>
  static std::uint64_t count_alike(const Codes& codes, const Alike& are_alike) {
    std::uint64_t pairs = 0;
    std::uint64_t alike = 0;
    for (std::size_t k = 1; k < codes.size(); ++k) {
      alike = are_alike(codes[k], codes[k - 1]) ? alike + 1 : 0;
      pairs += alike;
    }
    return pairs;
  }

  /// Interleaves 21 bits of each coordinate, from bit `from` on.
  static std::uint64_t code_of(const Cell& cell, int from) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << kMortonBits) - 1;
    return spread(cell.x >> from & kMask) | spread(cell.y >> from & kMask) << 1 |
           spread(cell.z >> from & kMask) << 2;
  }

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

  bool is_wide_;
  std::vector<std::uint64_t> codes_;
  std::vector<WideCode> wide_;
};

}  // namespace octocell
