// SPDX-License-Identifier: MIT
#pragma once

namespace octocell::on_thrust {

/// Returns how many of `count` threads, including the caller's, the system gives, by trying. OpenMP
/// does not try: if it gets no thread, it ends the program.
int threads_to_be_had(int count);

}  // namespace octocell::on_thrust
