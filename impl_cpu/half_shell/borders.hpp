// SPDX-License-Identifier: MIT
// Rows several diameters wide: which of their spheres may have partners in an adjacent row?
//
// Only those that a diameter reaches over the border, so all others are left out. Cells are
// monotone in the coordinate: where fl(place + diameter) lies in a cell or below it, so does every
// partner of a sphere at `place` or below it (docs/exactness.md, "Half shell"). Where the border
// lies is a guess; that it is a good one is asked of the cell formula, and where it is not, no
// sphere is left out. Nor is one where an axis wraps and the row has spheres of several far cells.
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

/// Centres of a row that may have partners in a certain other row lie in this, borders excluded.
struct Strip {
  float lowest_y = -HUGE_VALF;
  float highest_y = HUGE_VALF;
  float lowest_z = -HUGE_VALF;
  float highest_z = HUGE_VALF;
};

/// Between two adjacent cells of an axis: partners lie above `lower` in the lower of the two, and
/// below `upper` in the upper.
struct Border {
  float lower = -HUGE_VALF;
  float upper = HUGE_VALF;
};

/// The cell of an axis, not wrapped, that all values lie in; none if they lie in several. There is
/// at least one value.
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

/// Below cell `above`, not wrapped, for spheres whose centres are at most `distance` apart.
inline Border border_below(const Grid& grid, int axis, std::uint32_t above, float distance) {
  if (above == 0 || !std::isfinite(distance)) return {};
  const double place =
      (grid.first_unit[axis] + static_cast<double>(grid.width[axis].units) * above) /
      static_cast<double>(grid.units_per_length);
  const double wide = distance;
  const double apart = wide + 0x1p-22 * (std::fabs(place) + wide);  // what two sums may lose
  const auto lower = static_cast<float>(place - apart);
  const auto upper = static_cast<float>(place + apart);
  Border found;
  if (cell_coordinate(grid, axis, lower + distance) < above) found.lower = lower;
  if (cell_coordinate(grid, axis, upper - distance) >= above) found.upper = upper;
  return found;
}

}  // namespace octocell::cpu::half_shell
