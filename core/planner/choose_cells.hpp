// SPDX-License-Identifier: MIT
#pragma once

#include "core/planner/planner.hpp"

namespace octocell {

/// The id bits of a plan that may not use how few the grid needs.
inline constexpr int kIdBits = 32;

/// Gives the plan its grid or levels, and the bits of their ids; its method is already chosen.
/// Throws LimitError if the rule's conditions do not hold.
void choose_cells(Plan& plan, const SceneStats& stats, const PlanOptions& options);

}  // namespace octocell
