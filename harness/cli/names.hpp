// SPDX-License-Identifier: MIT
// Names on the command line, turned into what they stand for.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <string_view>
#include <thread>

#include "harness/interface/error.hpp"
#include "harness/interface/plan.hpp"

namespace octocell::cli {

/// The enumerator of that name. Throws InputError listing what is known.
template <typename Enum>
Enum enumerator_named(std::string_view what, std::string_view name,
                      std::span<const std::string_view> names) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw InputError(fmt::format("unknown {} '{}'; known: {}", what, name, fmt::join(names, ", ")));
  }
  return static_cast<Enum>(found - names.begin());
}

inline Method method_named(std::string_view name) {
  return enumerator_named<Method>("method", name, kMethodNames);
}
inline Rule rule_named(std::string_view name) {
  return enumerator_named<Rule>("rule", name, kRuleNames);
}

inline constexpr const char* kFlagsHelp =
    "NPY beside the scene, (N,): uint32 words of flags, or bool: which spheres are static";

inline constexpr int kMaxThreads = 1024;

/// 0 stands for all hardware threads.
inline int thread_count(int asked) {
  if (asked < 0 || asked > kMaxThreads) {
    throw InputError(
        fmt::format("--threads {}: must be 1 to {}, or 0 for all", asked, kMaxThreads));
  }
  return asked != 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

inline std::chrono::duration<double> time_limit(double seconds) {
  if (!(seconds > 0.0) || seconds > 1e6) {
    throw InputError(fmt::format("--timeout {}: must be above 0 and at most 1e6 seconds", seconds));
  }
  return std::chrono::duration<double>(seconds);
}

}  // namespace octocell::cli
