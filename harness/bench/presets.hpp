// SPDX-License-Identifier: MIT
// The groups of each preset: which scenes, sizes, motions and rounds.
#pragma once

#include <string_view>
#include <vector>

#include "harness/bench/groups.hpp"

namespace octocell::bench {

/// Returns the groups of a preset, small ones first. Real scenes that were not downloaded are
/// marked unavailable. Throws InputError that lists the known presets.
std::vector<Group> groups_of_preset(std::string_view name);

}  // namespace octocell::bench
