// SPDX-License-Identifier: MIT
// Why a recorded run lacks an array, where the reason is the same for several backends.
#pragma once

#include <string_view>

namespace octocell::not_recorded {

inline constexpr std::string_view kNoControlBits =
    "only rule chapter32 has control bits of spheres";
inline constexpr std::string_view kInOrder = "the ids were in order: nothing was sorted";
inline constexpr std::string_view kRowsInstead = "half_shell has rows of cells instead";
inline constexpr std::string_view kNoRows = "only half_shell has rows";
inline constexpr std::string_view kTilesInstead =
    "method tiles has no ids: spheres are put into tiles and sorted there, in shared memory";
inline constexpr std::string_view kNoCandidates =
    "half_shell and tiles note only spheres that may overlap";

}  // namespace octocell::not_recorded
