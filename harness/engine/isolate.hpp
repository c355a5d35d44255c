// SPDX-License-Identifier: MIT
// Runs a finder in a process of its own: a crash or an endless loop is then a result, too.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"

namespace octocell {

struct IsolatedAnswer {
  Counts counts;  // without plan_violation, which is thrown instead
  PairDigest digest;
  std::vector<Pair> pairs;  // as from download(); empty if over the candidate limit
};

/// Calls find_completely() in a child process, which then ends. The finder is created there, so its
/// threads belong to the child; the caller must have no threads that hold locks. Throws what the
/// child threw (InputError, LimitError). Throws LimitError if the child crashed ("crashed with
/// SIGSEGV"), did not answer in time ("no answer within 60 s"), or could not be started.
IsolatedAnswer find_isolated(const std::function<std::unique_ptr<PairFinder>()>& create,
                             SceneView scene, const PlanOptions& options,
                             std::chrono::duration<double> limit);

}  // namespace octocell
