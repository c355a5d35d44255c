// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>

#include "core/plan.hpp"
#include "core/stage.hpp"

namespace octocell::bench {

/// Returns the least bytes that each stage of a method must move for these counts: every input is
/// read once, every output is written once. Together with the stage's time, this shows how close it
/// comes to the bandwidth of a copy.
std::map<Stage, std::uint64_t> stage_bytes(Method method, std::uint64_t spheres,
                                           const Counts& counts);

}  // namespace octocell::bench
