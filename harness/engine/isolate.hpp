// SPDX-License-Identifier: MIT
// Runs a finder in a process of its own: a crash or an endless loop is then a result, too.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"
#include "harness/engine/finder_answer.hpp"

namespace octocell {

/// Calls find_completely() in a child process, which then ends. The finder is created there, so its
/// threads belong to the child; the caller must have no threads that hold locks. Pairs are as
/// from download(), and none if over the candidate limit. Throws a violation of the plan, and what
/// the child threw (InputError, LimitError). Throws LimitError if the child crashed ("crashed with
/// SIGSEGV"), did not answer in time ("no answer within 60 s"), or could not be started.
FinderAnswer find_isolated(const std::function<std::unique_ptr<PairFinder>()>& create,
                           SceneView scene, const PlanOptions& options,
                           std::chrono::duration<double> limit);

}  // namespace octocell
