// SPDX-License-Identifier: MIT
// Is the predicate right where it is hardest to be? Pairs that nearly touch, by the thousand
// million, against integers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "harness/verify/near_tangent/trial.hpp"

namespace octocell::near_tangent {

/// Pairs [begin, end) of a family on the host's threads.
Tally try_on_host(Family family, std::uint64_t begin, std::uint64_t end, int threads);

/// Why there is no device to do it on, if there is none.
std::optional<std::string> why_no_device();
/// The same pairs on the device.
Tally try_on_device(Family family, std::uint64_t begin, std::uint64_t end);

}  // namespace octocell::near_tangent
