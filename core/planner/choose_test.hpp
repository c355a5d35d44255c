// SPDX-License-Identifier: MIT
#pragma once

#include "core/planner/planner.hpp"

namespace octocell {

/// The cheapest test that answers what the predicate asks for, for this scene.
PairTest choose_test(const SceneStats& stats, const PlanOptions& options);

/// The facts without those that the test does not rest on: they need not be checked again.
PlanFacts needed_facts(PlanFacts facts, Predicate predicate, PairTest test);

/// The units of a packed test; nothing for others.
Packing choose_packing(const PlanFacts& facts, PairTest test);

}  // namespace octocell
