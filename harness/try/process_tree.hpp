// SPDX-License-Identifier: MIT
// A process and those that it started.
#pragma once

#include <sys/types.h>

#include <cstddef>

namespace octocell::hand_in {

struct TreeUse {
  double resident_bytes;  // 0 if the system does not say
  std::size_t processes;
};

/// Returns what the process and all below it use.
TreeUse use_of(pid_t id);

/// Sends a signal to all processes below.
void signal_descendants(pid_t id, int number);

/// From now on, processes whose parents ended become this process's own.
void adopt_orphans();
/// Ends all processes below this one, also those that start others as fast as they can. For a
/// caller that has no children of its own.
void end_descendants();

}  // namespace octocell::hand_in
