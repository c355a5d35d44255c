// SPDX-License-Identifier: MIT
// What frames of a moving scene do in addition to the stages (rules.hpp says when). Each function
// queues one kernel.
#pragma once

#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom::coherence {

/// Stage 1 of a frame that may reuse data: decides its mode and initializes State for it.
void open_frame(Workspace& w);

/// Stage 5 of a frame with a valid neighbor list: tests the neighbor pairs again.
void test_neighbor_list(Workspace& w);

}  // namespace octocell::cuda_custom::coherence
