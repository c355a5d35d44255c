// SPDX-License-Identifier: MIT
// A process and those that it started.
#pragma once

#include <sys/types.h>

namespace octocell::hand_in {

/// Returns the resident memory of the process and of all below it; 0 if the system does not say.
double resident_bytes(pid_t id);

/// From now on, processes whose parents ended become this process's own.
void adopt_orphans();
/// Ends all children of this process. For a caller that has no children of its own.
void end_orphans();

}  // namespace octocell::hand_in
