// SPDX-License-Identifier: MIT
#pragma once

#include "core/finder.hpp"

namespace octocell {

/// Returns a first plan with lists that fit into the available memory. (Room that is never written
/// costs nothing, so lists are long. But what is written must exist, and a list that is too short
/// reports how long it must be.) Throws LimitError that says how much is needed if not even the
/// certain part fits. Otherwise the kernel would kill the program later.
Plan within_memory(const Plan& plan, const HostBytes& bytes);

/// Does the same for the plan after a run whose lists were too short.
Plan grow_within_memory(const Plan& plan, const HostBytes& bytes, const Counts& found);

}  // namespace octocell
