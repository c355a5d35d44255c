// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/planner/planner.hpp"

namespace octocell {

/// What the caller fixed and is expected to pay dearly for, one line each. `plan` is the one that
/// was made with `options`.
std::vector<std::string> warnings_of(const SceneStats& stats, const Plan& plan,
                                     const PlanOptions& options);

}  // namespace octocell
