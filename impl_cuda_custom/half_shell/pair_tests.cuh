// SPDX-License-Identifier: MIT
#pragma once

#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom::half_shell {

/// Runs stage 5 of half_shell.
void pair_tests(Workspace& w);

}  // namespace octocell::cuda_custom::half_shell
