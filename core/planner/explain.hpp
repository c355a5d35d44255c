// SPDX-License-Identifier: MIT
// Explains why a plan is as it is, like EXPLAIN for a database query.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/planner/planner.hpp"

namespace octocell {

/// One skip: whether the plan takes it, and the reason.
struct Decision {
  Skip skip = Skip::grid;
  bool taken = false;
  std::string fact;  // the fact of this scene for or against it
  /// The part of the time without this skip that it is expected to save; none if the cost model
  /// does not cover it.
  std::optional<double> expected_saving = {};
  std::optional<double> measured_saving = {};  // filled in by the caller
};

struct Explanation {
  std::string scene;   // the scene that was measured
  std::string method;  // the method and its cells
  std::string sort;
  std::string predicate;
  std::vector<Decision> decisions;    // one for each skip, in the order of Skip
  std::vector<std::string> warnings;  // options that the caller fixed and should better leave to
                                      // the planner
};

/// Explains a plan. `options` must be those that it was made with. `used` is what the data allowed
/// in a run, if there was one.
Explanation explain(const SceneStats& stats, const Plan& plan, const PlanOptions& options,
                    std::optional<Skips> used = {});

/// Formats a short tree, one line a decision.
std::string to_text(const Explanation& explanation);

/// Returns the options without that skip. If the skip is a method, the planner chooses the method.
PlanOptions without_skip(PlanOptions options, Skip skip);

}  // namespace octocell
