// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "harness/bench/rows.hpp"

namespace octocell::bench {

/// Returns how much resident memory grows beyond the scene itself while the row finds its pairs
/// once, in its own child process. Returns none if /proc does not say.
std::optional<std::uint64_t> peak_bytes(const RowSpec& row, const Group& group);

}  // namespace octocell::bench
