// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "harness/bench/rows.hpp"

namespace octocell::bench {

/// Growth of resident memory over the scene itself while the row finds its pairs once, in a child
/// process of its own. Nothing where /proc does not tell.
std::optional<std::uint64_t> peak_bytes(const RowSpec& row, const Group& group);

}  // namespace octocell::bench
