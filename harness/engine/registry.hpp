// SPDX-License-Identifier: MIT
// The one list of everything that can answer: our backends and the baselines.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"

namespace octocell {

enum class Kind : std::uint8_t { backend, baseline };

struct BackendInfo {
  std::string_view name;  // of a backend: its folder's, + _cuda on a device; of a baseline:
                          // library, class, tuning
  Kind kind;
  std::string_view summary;                    // one line, for people
  std::span<const Method> methods;             // empty for baselines: they have their own
  std::span<const Predicate> predicates = {};  // likewise
  Skips skips = Skips::all();                  // what it can leave out
  bool threaded;                               // false: one thread whatever the plan says
  /// Nothing if it can run here, else why not.
  std::optional<std::string> (*why_unavailable)();
  std::unique_ptr<PairFinder> (*create)();
  /// It computes on a device, with memory of its own.
  bool device = false;
  /// It has device_runs().
  bool has_device_runs = false;
  /// What the planner weighs cells by.
  Costs costs = {};
  /// Why its answers can lack pairs although it is driven as it should be; empty if they cannot.
  std::string_view known_issues = {};
};

/// Backends first, then baselines; the order of every table and plot.
std::span<const BackendInfo> backends();

/// The entry of that name. Throws InputError listing the known names.
const BackendInfo& backend_named(std::string_view name);

/// One way to answer: a row of every table.
struct Implementation {
  const BackendInfo* backend;
  std::optional<Method> method = {};  // of our backends; none: the planner chooses
  Rule rule = Rule::lowest_cell;      // of method home_phantom
  Predicate predicate = Predicate::exact;

  [[nodiscard]] bool is_baseline() const { return backend->kind == Kind::baseline; }
  [[nodiscard]] bool has_rule() const { return !is_baseline() && method == Method::home_phantom; }
  /// Ours, as the planner would have it.
  [[nodiscard]] bool planned() const { return !is_baseline() && !method; }
  /// "planned" or the method's name.
  [[nodiscard]] std::string_view method_name() const {
    return method ? name_of(*method) : "planned";
  }
  /// Kept because it is wrong: its losses are the lesson, and no row of it counts as a failure.
  [[nodiscard]] bool negative_control() const {
    return (has_rule() && rule == Rule::as_written) || !claims_exact(predicate);
  }
  /// A library's own fault: pairs that such a row lacks are reported, and not counted as a failure.
  [[nodiscard]] bool has_known_issues() const { return !backend->known_issues.empty(); }
  /// What the planner is told of it.
  [[nodiscard]] PlanOptions plan_options(int threads = 1) const;
  /// "impl_cpu planned", "impl_cpu planned f32", "impl_cpu home_phantom lowest_cell"
  [[nodiscard]] std::string label() const;
};

/// All that are exact by the default predicate, or those of one backend ("all" or a name).
std::vector<Implementation> implementations(std::string_view backend = "all");

/// The planned method with each other predicate that a backend has.
std::vector<Implementation> other_predicates(std::string_view backend = "all");

}  // namespace octocell
