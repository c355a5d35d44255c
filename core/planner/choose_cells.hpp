// SPDX-License-Identifier: MIT
#pragma once

#include "core/planner/planner.hpp"

namespace octocell {

/// Of a plan that does not know its ids.
inline constexpr int kIdBits = 32;

/// Gives the plan, whose method is chosen, its grid or levels, and the bits of their ids. Throws
/// LimitError where the rule's conditions do not hold.
void choose_cells(Plan& plan, const SceneStats& stats, const PlanOptions& options);

}  // namespace octocell
