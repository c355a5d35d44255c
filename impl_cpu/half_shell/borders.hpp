// SPDX-License-Identifier: MIT
// Rows several diameters wide: which of their spheres may have partners in an adjacent row?
//
// Only spheres within a diameter of the border; all others are left out. Cells are monotone in the
// coordinate: if fl(place + diameter) lies below a border, so do all partners of a sphere at
// `place` or below (docs/exactness.md, "Half shell"). The position of the border is a guess, which
// the cell formula checks; if it is wrong, no sphere is left out. Nor is any left out if an axis
// wraps and the row has spheres of several far cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "core/grid.hpp"
#include "core/simd.hpp"
#include "impl_cpu/block_size.hpp"

namespace octocell::cpu::half_shell {

/// The centres of a row that may have partners in a certain other row lie in this strip, without
/// its borders.
struct Strip {
  float lowest_y = -HUGE_VALF;
  float highest_y = HUGE_VALF;
  float lowest_z = -HUGE_VALF;
  float highest_z = HUGE_VALF;
};

/// The border between two adjacent cells of an axis. Partners in the lower cell lie above `lower`;
/// partners in the upper cell lie below `upper`.
struct Border {
  float lower = -HUGE_VALF;
  float upper = HUGE_VALF;
};

/// Returns the cell of an axis, not wrapped, that holds all values; none if several cells do. There
/// must be at least one value.
inline std::optional<std::uint32_t> common_cell(const Grid& grid, int axis,
                                                std::span<const float> values) {
  using Floats = Vector<float, block_size(16, 4)>;
  float lowest = values.front();
  float highest = lowest;
  Floats low(lowest);
  Floats high(lowest);
  for (; values.size() >= Floats::size(); values = values.subspan(Floats::size())) {
    const Floats some(values.data(), stdx::element_aligned);
    low = stdx::min(low, some);
    high = stdx::max(high, some);
  }
  for (const float value : values) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  const std::uint32_t cell = cell_coordinate(grid, axis, std::min(lowest, stdx::hmin(low)));
  if (cell_coordinate(grid, axis, std::max(highest, stdx::hmax(high))) != cell) return {};
  return cell;
}

/// Returns the border below cell `above`, not wrapped, for partners at most `distance` apart.
inline Border border_below(const Grid& grid, int axis, std::uint32_t above, float distance) {
  if (above == 0 || !std::isfinite(distance)) return {};
  const double place =
      (grid.first_unit[axis] + static_cast<double>(grid.width[axis].units) * above) /
      static_cast<double>(grid.units_per_length);
  const double wide = distance;
  const double apart = wide + 0x1p-22 * (std::fabs(place) + wide);  // what the roundings of two
                                                                    // sums may lose
  const auto lower = static_cast<float>(place - apart);
  const auto upper = static_cast<float>(place + apart);
  Border found;
  if (cell_coordinate(grid, axis, lower + distance) < above) found.lower = lower;
  if (cell_coordinate(grid, axis, upper - distance) >= above) found.upper = upper;
  return found;
}

}  // namespace octocell::cpu::half_shell
