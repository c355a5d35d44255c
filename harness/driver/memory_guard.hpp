// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "harness/interface/plan.hpp"

namespace octocell {

/// What the system could give without swapping; none where /proc/meminfo does not tell.
std::optional<double> available_bytes();

/// A grown plan's buffers will be filled to the end, so they must fit into what memory is
/// available now. Throws LimitError that says how much is needed, instead of leaving the matter to
/// the kernel, which would end the program. Says nothing where /proc/meminfo does not tell.
void require_memory(const Plan& plan);

}  // namespace octocell
