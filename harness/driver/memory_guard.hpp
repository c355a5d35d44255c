// SPDX-License-Identifier: MIT
#pragma once

#include "harness/interface/plan.hpp"

namespace octocell {

/// A grown plan's buffers will be filled to the end, so they must fit into what memory is
/// available now. Throws LimitError that says how much is needed, instead of leaving the matter to
/// the kernel, which would end the program. Says nothing where /proc/meminfo does not tell.
void require_memory(const Plan& plan);

}  // namespace octocell
