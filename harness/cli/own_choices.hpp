// SPDX-License-Identifier: MIT
// What a caller may fix of a plan: the options that find and explain share.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/planner/planner.hpp"
#include "harness/cli/names.hpp"
#include "harness/engine/registry.hpp"

namespace octocell::cli {

struct OwnChoices {
  std::string method;
  std::string rule;
  std::optional<double> cell_side;
  std::vector<std::string> no_skip;
  std::vector<std::string> force;

  [[nodiscard]] bool any() const {
    return !method.empty() || !rule.empty() || cell_side || !no_skip.empty() || !force.empty();
  }
};

inline void add_own_choices(CLI::App& sub, OwnChoices& own) {
  sub.add_option(
      "--method", own.method,
      "planned (default: the planner chooses), home_phantom, half_shell, brute_force or tiles");
  sub.add_option("--rule", own.rule,
                 "For home_phantom: lowest_cell (default), chapter32 or as_written");
  sub.add_option("--cell-side", own.cell_side, "Cell side in scene units, for rule lowest_cell");
  add_skip_options(sub, own.no_skip, own.force);
}

/// Sets the implementation's method and rule. Throws InputError if they do not fit together.
inline void choose_method(Implementation& chosen, const OwnChoices& own) {
  chosen.method = method_or_planned(own.method);
  const auto& methods = chosen.backend->methods;
  if (chosen.method && !chosen.is_baseline() &&
      std::ranges::find(methods, *chosen.method) == methods.end()) {
    throw InputError(fmt::format("{} has no method {}", chosen.backend->name, own.method));
  }
  if (!own.rule.empty()) chosen.rule = rule_named(own.rule);
  const bool of_home_phantom = !own.rule.empty() || own.cell_side;
  if (chosen.planned() && of_home_phantom) chosen.method = Method::home_phantom;
  if (!chosen.has_rule() && of_home_phantom) {
    throw InputError(fmt::format("method {} has no rules and no cells", chosen.method_name()));
  }
}

inline PlanOptions plan_options_of(const Implementation& chosen, const OwnChoices& own,
                                   int threads) {
  PlanOptions options =
      with_skips(chosen.plan_options(thread_count(threads)), own.no_skip, own.force);
  options.cell_side = own.cell_side;
  return options;
}

}  // namespace octocell::cli
