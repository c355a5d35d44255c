// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/grid.hpp"

namespace octocell::cpu::half_shell {

/// Returns the cell one step along an axis; none beyond the border of an axis that does not wrap.
inline std::optional<std::uint32_t> step_along(const Grid& grid, int axis, std::uint32_t at,
                                               int step) {
  if (step == 0) return at;
  const std::uint32_t last = grid.period(axis) - 1;
  const bool at_border = at == (step < 0 ? 0 : last);
  if (!at_border) return at + static_cast<std::uint32_t>(step);
  if (!grid.wraps(axis)) return std::nullopt;
  return step < 0 ? last : 0;
}

}  // namespace octocell::cpu::half_shell
