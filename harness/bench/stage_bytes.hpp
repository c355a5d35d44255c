// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>

#include "core/plan.hpp"
#include "core/stage.hpp"

namespace octocell::bench {

/// The least that each stage of a method must move through memory for what it met: every input
/// read once, every output written once, nothing twice. Against its time, how near a stage comes
/// to the bandwidth of a copy.
std::map<Stage, std::uint64_t> stage_bytes(Method method, std::uint64_t spheres,
                                           const Counts& counts);

}  // namespace octocell::bench
