// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <thread>

#include "core/error.hpp"

namespace octocell {

inline constexpr int kMaxThreads = 1024;

/// Returns the number of threads to start; 0 means all hardware threads. Throws InputError that
/// names the option.
inline int threads_for(std::string_view option, int asked) {
  if (asked < 0 || asked > kMaxThreads) {
    throw InputError(
        fmt::format("{} {}: must be 1 to {}, or 0 for all", option, asked, kMaxThreads));
  }
  return asked != 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace octocell
