// SPDX-License-Identifier: MIT
// Converts names on the command line.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/plan.hpp"
#include "core/planner/planner.hpp"
#include "harness/engine/registry.hpp"
#include "harness/engine/threads_for.hpp"

namespace octocell::cli {

/// Returns the enumerator of that name. Throws InputError that lists the known names.
template <typename Enum>
Enum enumerator_named(std::string_view what, std::string_view name,
                      std::span<const std::string_view> names) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw InputError(fmt::format("unknown {} '{}'; known: {}", what, name, fmt::join(names, ", ")));
  }
  return static_cast<Enum>(found - names.begin());
}

/// Throws LimitError with the reason if the backend cannot run here; for commands that need it.
inline void require_available(const BackendInfo& backend) {
  if (const auto reason = backend.why_unavailable()) {
    throw LimitError(fmt::format("{} cannot run here: {}", backend.name, *reason));
  }
}

/// Returns none if the planner chooses.
inline std::optional<Method> method_or_planned(std::string_view name) {
  if (name.empty() || name == "planned") return std::nullopt;
  return enumerator_named<Method>("method", name, kMethodNames);
}
inline Rule rule_named(std::string_view name) {
  return enumerator_named<Rule>("rule", name, kRuleNames);
}

/// Returns a predicate that the backend has. Throws InputError that lists those.
inline Predicate predicate_named(std::string_view name, const BackendInfo& backend) {
  const auto predicate = enumerator_named<Predicate>("predicate", name, kPredicateNames);
  if (std::ranges::find(backend.predicates, predicate) != backend.predicates.end()) {
    return predicate;
  }
  std::vector<std::string_view> known;
  for (const Predicate p : backend.predicates) known.push_back(name_of(p));
  throw InputError(fmt::format("{} has no predicate {}; it has: {}", backend.name, name,
                               fmt::join(known, ", ")));
}
inline constexpr const char* kPredicateHelp =
    "How two spheres are tested: exact (default), q16_exact, or one that can be wrong: f32, "
    "f32_sqrt, f64, aabb_only, f16_cell, q16_cell, gram_f32";

inline Skips skips_named(const std::vector<std::string>& names) {
  Skips skips;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(kSkips, std::string_view(name), &SkipInfo::name);
    if (found == kSkips.end()) {
      std::vector<std::string_view> known;
      for (const SkipInfo& skip : kSkips) known.push_back(skip.name);
      throw InputError(fmt::format("unknown skip '{}'; known: {}", name, fmt::join(known, ", ")));
    }
    skips = skips.with(static_cast<Skip>(found - kSkips.begin()));
  }
  return skips;
}

/// Adds the flags --no-skip and --force.
inline void add_skip_options(CLI::App& sub, std::vector<std::string>& no_skip,
                             std::vector<std::string>& force) {
  sub.add_option("--no-skip", no_skip, "Forbid this skip (repeatable)");
  sub.add_option("--force", force, "Force this skip, or fail with the reason (repeatable)");
}
inline PlanOptions with_skips(PlanOptions options, const std::vector<std::string>& no_skip,
                              const std::vector<std::string>& force) {
  const Skips forbidden = skips_named(no_skip);
  options.forced = skips_named(force);
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    const auto skip = static_cast<Skip>(k);
    if (forbidden.has(skip) && options.forced.has(skip)) {
      throw InputError(fmt::format("skip {} is forced and forbidden", name_of(skip)));
    }
    if (forbidden.has(skip)) options.allowed = options.allowed.without(skip);
  }
  return options;
}

/// Throws LimitError if a forced skip that depends on the data was not used.
inline void require_used(Skips forced, Skips used) {
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    const auto skip = static_cast<Skip>(k);
    if (!forced.has(skip) || is_planned(skip) || used.has(skip)) continue;
    throw LimitError(
        fmt::format("skip {} cannot be forced here: the data do not allow it (needed: {})",
                    name_of(skip), kSkips[k].proof));
  }
}

/// Returns the number of threads for --threads.
inline int thread_count(int asked) { return threads_for("--threads", asked); }

/// Prints once on stderr if a run had fewer threads than requested.
inline void say_if_threads_lack(const Plan& plan, const Counts& counts) {
  static bool is_said = false;
  if (is_said || counts.threads == 0 || counts.threads >= plan.threads) return;
  is_said = true;
  fmt::print(stderr, "octocell: {} threads were requested, but the system gave {}\n", plan.threads,
             counts.threads);
}

inline void add_plugin_option(CLI::App& sub, std::vector<std::string>& plugins) {
  sub.add_option("--plugin", plugins,
                 "A shared library with find_pairs (octocell_plugin.h), as one more row "
                 "(repeatable)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}
/// Adds the rows. Returns the name of the first; none if there is no plug-in.
inline std::optional<std::string_view> load_plugins(const std::vector<std::string>& plugins) {
  std::optional<std::string_view> first;
  for (const std::string& path : plugins) {
    const std::string_view name = add_plugin(path).name;
    if (!first) first = name;
  }
  return first;
}

inline std::chrono::duration<double> time_limit(double seconds) {
  if (!(seconds > 0.0) || seconds > 1e6) {
    throw InputError(fmt::format("--timeout {}: must be above 0 and at most 1e6 seconds", seconds));
  }
  return std::chrono::duration<double>(seconds);
}

}  // namespace octocell::cli
