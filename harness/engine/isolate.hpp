// SPDX-License-Identifier: MIT
// A finder in a process of its own: if it crashes or never ends, that is an answer, too.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"

namespace octocell {

struct IsolatedAnswer {
  Counts counts;  // without plan_violation: that is thrown
  PairDigest digest;
  std::vector<Pair> pairs;  // as download() gives them; empty over the candidate limit
};

/// find_completely() in a child process, which ends with it. The finder is created there, so that
/// its threads are the child's; the caller must have none that hold locks.
/// Throws what the child threw (InputError, LimitError), and LimitError if the child crashed
/// ("crashed with SIGSEGV"), did not answer in time ("no answer within 60 s"), or could not be
/// made.
IsolatedAnswer find_isolated(const std::function<std::unique_ptr<PairFinder>()>& create,
                             SceneView scene, const PlanOptions& options,
                             std::chrono::duration<double> limit);

}  // namespace octocell
