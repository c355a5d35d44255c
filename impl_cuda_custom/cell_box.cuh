// SPDX-License-Identifier: MIT
// The cells that a sphere's box meets, numbered, so that any thread can name any one of them.
#pragma once

#include "harness/interface/grid.hpp"
#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {

__device__ inline Object object_of(std::uint32_t sphere, Cell cell, Cell lowest) {
  const Object at_lowest = (cell.x == lowest.x ? 1U : 0U) | (cell.y == lowest.y ? 2U : 0U) |
                           (cell.z == lowest.z ? 4U : 0U);
  return sphere | at_lowest << kLowestShift;
}

/// Cells are numbered along x, then y, then z. Numbers are 32-bit: a sphere with more phantoms than
/// that has no room in any plan, and none of its cells is ever asked for.
struct CellBox {
  Cell lowest;
  std::uint32_t width_x;
  std::uint32_t width_y;
  std::uint32_t home;  // the home cell's number

  /// The cell of phantom number `phantom`: all cells in order, but the home.
  [[nodiscard]] __device__ Cell phantom_cell(std::uint32_t phantom) const {
    const std::uint32_t number = phantom < home ? phantom : phantom + 1;
    const std::uint32_t row = number / width_x;
    const std::uint32_t layer = row / width_y;
    return {lowest.x + number - row * width_x, lowest.y + row - layer * width_y, lowest.z + layer};
  }
};

__device__ inline CellBox box_of(const CellRange& met, Cell home) {
  CellBox box;
  box.lowest = met.lowest;
  box.width_x = met.highest.x - met.lowest.x + 1;
  box.width_y = met.highest.y - met.lowest.y + 1;
  box.home = (home.x - met.lowest.x) +
             box.width_x * ((home.y - met.lowest.y) + box.width_y * (home.z - met.lowest.z));
  return box;
}

__device__ inline std::uint64_t phantoms_in(const CellRange& met) {
  return std::uint64_t{met.highest.x - met.lowest.x + 1} * (met.highest.y - met.lowest.y + 1) *
             (met.highest.z - met.lowest.z + 1) -
         1;
}

__device__ inline bool meets_three_cells(const CellRange& met) {
  return met.highest.x - met.lowest.x > 1 || met.highest.y - met.lowest.y > 1 ||
         met.highest.z - met.lowest.z > 1;
}

/// Bits 3..10: which of the eight types occur among the cells met.
__device__ inline chapter32::ControlBits control_bits_of(const CellRange& met, Cell home) {
  std::uint32_t types = 0;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const Cell cell = {(corner & 1U) != 0 ? met.highest.x : met.lowest.x,
                       (corner & 2U) != 0 ? met.highest.y : met.lowest.y,
                       (corner & 4U) != 0 ? met.highest.z : met.lowest.z};
    types |= 1U << chapter32::cell_type(cell);
  }
  return static_cast<chapter32::ControlBits>(types << 3 | chapter32::cell_type(home));
}

}  // namespace octocell::cuda_custom
