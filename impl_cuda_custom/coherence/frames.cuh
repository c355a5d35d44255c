// SPDX-License-Identifier: MIT
// What frames of a moving scene do besides the stages (rules.hpp says when). Each of these queues
// one kernel.
#pragma once

#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom::coherence {

/// Stage 1 of a frame that may take over something: decides its course, and opens State for it.
void open_frame(Workspace& w);

/// Stage 5 of frames that are not searched: the neighbor pairs, tested again.
void test_neighbor_list(Workspace& w);

}  // namespace octocell::cuda_custom::coherence
