// SPDX-License-Identifier: MIT
#pragma once

namespace octocell::on_thrust {

/// Returns how many of `count` threads, the caller's among them, the system gives: it tries. OpenMP
/// does not ask; where it gets no thread it ends the program.
int threads_to_be_had(int count);

}  // namespace octocell::on_thrust
