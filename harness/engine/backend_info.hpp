// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"

namespace octocell {

enum class Kind : std::uint8_t { backend, baseline };

/// What is known of a backend or a baseline: a row of the registry.
struct BackendInfo {
  std::string_view name;  // a backend's folder, + _cuda for a GPU; a baseline's library, class,
                          // tuning
  Kind kind;
  std::string_view summary;                    // one line for users
  std::span<const Method> methods;             // empty for baselines, which have their own
  std::span<const Predicate> predicates = {};  // the same
  Skips skips = Skips::all();                  // the skips that it has
  bool threaded;                               // false: one thread, whatever the plan says
  /// Returns none if it can run here, otherwise why not.
  std::optional<std::string> (*why_unavailable)();
  std::function<std::unique_ptr<PairFinder>()> create;
  /// True if it computes on a GPU, with the GPU's memory.
  bool device = false;
  /// True if it has device_runs().
  bool has_device_runs = false;
  /// The costs by which the planner compares methods and cells.
  Costs costs = {};
  /// Why its answers can lack pairs although it is used correctly; empty if they cannot.
  std::string_view known_issues = {};
};

}  // namespace octocell
