// SPDX-License-Identifier: MIT
// What half_shell is expected to cost, level by level.
#pragma once

#include "core/planner/cost_model.hpp"
#include "core/planner/crowding.hpp"

namespace octocell {

/// Returns the cost of a level's spheres among themselves, with the sort of their ids.
double cost_of(const Level& level, const Members& members, const Crowding& crowding,
               const Costs& costs);

/// Returns the cost of testing the spheres of two levels against each other.
double cost_across(const SceneStats& stats, const Level& coarser, const Members& coarse,
                   const Level& finer, const Members& fine, const ShellCosts& costs);

}  // namespace octocell
