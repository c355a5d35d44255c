// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace octocell::bench {

/// Runs one benchmark of Google Benchmark with manual time: calls run_ms `iterations` times, each
/// of which returns its time in milliseconds, and returns the average.
double average_ms(const std::string& name, std::uint64_t iterations,
                  const std::function<double()>& run_ms);

}  // namespace octocell::bench
