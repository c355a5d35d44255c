// SPDX-License-Identifier: MIT
#pragma once

#include "core/planner/planner.hpp"

namespace octocell {

/// Returns the cheapest test that answers the predicate for this scene.
PairTest choose_test(const SceneStats& stats, const PlanOptions& options);

/// Returns only the facts that the test relies on; the others need not be checked again.
PlanFacts needed_facts(PlanFacts facts, Predicate predicate, PairTest test);

/// Returns the units of a packed test; nothing for other tests.
Packing choose_packing(const PlanFacts& facts, PairTest test);

}  // namespace octocell
