// SPDX-License-Identifier: MIT
// Why a plan is as it is, as EXPLAIN tells it of a query.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/planner/planner.hpp"

namespace octocell {

/// One skip: taken or not, and what speaks for it.
struct Decision {
  Skip skip = Skip::grid;
  bool taken = false;
  std::string fact;  // what of this scene it rests on, or what stands against it
  /// Part of the time without this skip that it is expected to save; none where the cost model does
  /// not know.
  std::optional<double> expected_saving = {};
  std::optional<double> measured_saving = {};  // for the caller to fill in
};

struct Explanation {
  std::string scene;   // what was seen
  std::string method;  // what was chosen, and its cells
  std::string sort;
  std::string predicate;
  std::vector<Decision> decisions;    // one a skip, in the order of Skip
  std::vector<std::string> warnings;  // what the caller fixed and would better have left open
};

/// `options` are those that the plan was made with. `used`: what the data allowed in a run, if one
/// was made.
Explanation explain(const SceneStats& stats, const Plan& plan, const PlanOptions& options,
                    std::optional<Skips> used = {});

/// A short tree, one line a decision.
std::string to_text(const Explanation& explanation);

/// The same options without that skip; one that is a method leaves the method to the planner.
PlanOptions without_skip(PlanOptions options, Skip skip);

}  // namespace octocell
