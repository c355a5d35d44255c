// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/planner/planner.hpp"

namespace octocell {

/// Returns one line for each thing that the caller fixed and that is expected to cost much time.
/// `plan` must be the one that was made with `options`.
std::vector<std::string> warnings_of(const SceneStats& stats, const Plan& plan,
                                     const PlanOptions& options);

}  // namespace octocell
