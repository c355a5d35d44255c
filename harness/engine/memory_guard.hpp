// SPDX-License-Identifier: MIT
#pragma once

#include "core/finder.hpp"

namespace octocell {

/// Returns a first plan with lists that fit into the memory that is available. (Room that is not
/// written to costs nothing, so lists are made long; but what is written must be there, and a list
/// that was too short says how long it must be.) Throws LimitError that says how much is needed if
/// not even what is certain fits, instead of leaving the matter to the kernel, which would end the
/// program.
Plan within_memory(const Plan& plan, const HostBytes& bytes);

/// The same for the plan after a run whose lists were too short.
Plan grow_within_memory(const Plan& plan, const HostBytes& bytes, const Counts& found);

}  // namespace octocell
