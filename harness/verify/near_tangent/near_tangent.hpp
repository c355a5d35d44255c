// SPDX-License-Identifier: MIT
// Is the predicate right where that is most difficult?  Compares it with integers on billions of
// pairs that nearly touch.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "harness/verify/near_tangent/trial.hpp"

namespace octocell::near_tangent {

/// Tries pairs [begin, end) of a family on the host's threads.
Tally try_on_host(Family family, std::uint64_t begin, std::uint64_t end, int threads);

/// Returns why there is no device to try them on; none if there is one.
std::optional<std::string> why_no_device();
/// Tries the same pairs on the device.
Tally try_on_device(Family family, std::uint64_t begin, std::uint64_t end);

}  // namespace octocell::near_tangent
