// SPDX-License-Identifier: MIT
// The list of everything that can answer: our backends and the baselines.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"
#include "harness/engine/backend_info.hpp"

namespace octocell {

/// Returns backends first, then baselines, then plug-ins: the order of every table and plot.
std::span<const BackendInfo> backends();

/// Returns the entry of that name. Throws InputError that lists the known names.
const BackendInfo& backend_named(std::string_view name);

/// Loads a shared library as one more row, "plugin_mine" for libmine.so, and returns its entry.
/// Throws InputError if it cannot be loaded, if its name is taken, or if there are too many.
const BackendInfo& add_plugin(const std::string& path);

/// One way to answer: a row of every table.
struct Implementation {
  const BackendInfo* backend;
  std::optional<Method> method = {};  // for our backends; none: the planner chooses
  Rule rule = Rule::lowest_cell;      // for method home_phantom
  Predicate predicate = Predicate::exact;

  [[nodiscard]] bool is_baseline() const { return backend->kind == Kind::baseline; }
  [[nodiscard]] bool has_rule() const { return !is_baseline() && method == Method::home_phantom; }
  /// Returns true for a backend whose method the planner chooses.
  [[nodiscard]] bool planned() const { return !is_baseline() && !method; }
  /// Returns "planned" or the method's name.
  [[nodiscard]] std::string_view method_name() const {
    return method ? name_of(*method) : "planned";
  }
  /// Returns true for a row that is kept because it is wrong: it shows what is lost, and never
  /// counts as a failure.
  [[nodiscard]] bool negative_control() const {
    return (has_rule() && rule == Rule::as_written) || !claims_exact(predicate);
  }
  /// Returns true for a library with known issues: pairs that its row lacks are reported, but do
  /// not count as a failure.
  [[nodiscard]] bool has_known_issues() const { return !backend->known_issues.empty(); }
  /// Returns the options that such a row gives to the planner.
  [[nodiscard]] PlanOptions plan_options(int threads = 1) const;
  /// Returns for example "impl_cpu planned", "impl_cpu planned f32", "impl_cpu home_phantom
  /// lowest_cell".
  [[nodiscard]] std::string label() const;
};

/// Returns all implementations that are exact by the default predicate, of one backend or of "all".
std::vector<Implementation> implementations(std::string_view backend = "all");

/// Returns the planned method with each other predicate that a backend has.
std::vector<Implementation> other_predicates(std::string_view backend = "all");

}  // namespace octocell
