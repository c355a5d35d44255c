// SPDX-License-Identifier: MIT
// The groups of each preset: which scenes, sizes, motions and rounds.
#pragma once

#include <string_view>
#include <vector>

#include "harness/bench/groups.hpp"

namespace octocell::bench {

/// Makes the groups of a preset, small ones first. Real scenes that were not downloaded are marked
/// unavailable.
using Preset = std::vector<Group> (*)();

/// Returns the preset of that name. Throws InputError that lists the known presets.
Preset preset_named(std::string_view name);

}  // namespace octocell::bench
