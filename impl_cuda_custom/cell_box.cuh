// SPDX-License-Identifier: MIT
// Numbers the cells that a sphere's box meets, so that any thread can compute any one of them.
#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {

/// Cells are numbered along x, then y, then z, with 32 bits. A sphere with more phantoms than that
/// fits into no plan, so none of its cells is ever computed.
struct CellBox {
  Cell lowest;
  std::uint32_t width_x;
  std::uint32_t width_y;
  std::uint32_t home;  // the home cell's number

  /// Returns the cell of phantom number `phantom`: all cells in order, without the home.
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

}  // namespace octocell::cuda_custom
