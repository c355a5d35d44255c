// SPDX-License-Identifier: MIT
#pragma once

namespace octocell::bench {

/// From here on the first Ctrl-C is only remembered, so that the run in progress can end; the
/// second ends the program at once.
void listen_for_interrupts();
bool interrupted();

}  // namespace octocell::bench
