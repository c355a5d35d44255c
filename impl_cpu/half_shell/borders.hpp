// SPDX-License-Identifier: MIT
// Rows several diameters wide: which of their spheres may have partners in an adjacent row?
//
// Only those that a diameter reaches over the border, so all others are left out. Cells are
// monotone in the coordinate: where fl(place + diameter) lies in a cell or below it, so does every
// partner of a sphere at `place` or below it (docs/exactness.md, "Half shell"). Where the border
// lies is a guess; that it is a good one is asked of the cell formula, and where it is not, no
// sphere is left out.
#pragma once

#include <cmath>

#include "harness/interface/grid.hpp"

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

/// Below cell `above`, for spheres whose centres are at most `reach` apart.
inline Border border_below(const Grid& grid, int axis, std::uint32_t above, float reach) {
  const bool one_border = !grid.wraps(axis) && above > 0;  // a wrapped row stands for several
  if (!one_border || !std::isfinite(reach)) return {};
  const double place =
      (grid.first_unit[axis] + static_cast<double>(grid.width[axis].units) * above) /
      static_cast<double>(grid.units_per_length);
  const double wide = reach;
  const double apart = wide + 0x1p-22 * (std::fabs(place) + wide);  // what two sums may lose
  const auto lower = static_cast<float>(place - apart);
  const auto upper = static_cast<float>(place + apart);
  Border found;
  if (cell_coordinate(grid, axis, lower + reach) < above) found.lower = lower;
  if (cell_coordinate(grid, axis, upper - reach) >= above) found.upper = upper;
  return found;
}

}  // namespace octocell::cpu::half_shell
