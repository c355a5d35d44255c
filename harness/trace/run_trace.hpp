// SPDX-License-Identifier: MIT
// One run of a backend, array by array: as JSON for tools (docs/trace.schema.json), as tables for a
// terminal, as a page to step through.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/plan.hpp"
#include "core/run_record.hpp"
#include "core/sphere.hpp"

namespace octocell::trace {

struct RunTrace {
  std::string scene;  // as a user names it
  std::string_view backend;
  SceneView view;
  Plan plan;
  std::optional<double> cell_side;  // that was asked for; cells are at least as wide
  RunRecord record;
  std::vector<Pair> pairs;  // sorted; a pair found twice appears twice
};

/// What stage 5, or stage 6 for it, decided about two entries, and by what.
struct Decision {
  std::string_view verdict;  // overlap, apart, skipped
  std::string_view reason;   // bound, lattice, exact, rule, flags
};
Decision decision_on(const Considered& considered, const RunTrace& trace);

/// Returns where each entry of `before` went. Equal entries keep their order.
std::vector<std::uint32_t> destinations(const SortPass& pass,
                                        const std::vector<std::uint32_t>& ids_before);

nlohmann::ordered_json to_json(const RunTrace& trace);
std::string to_text(const RunTrace& trace);

}  // namespace octocell::trace
