// SPDX-License-Identifier: MIT
#pragma once

namespace octocell::bench {

/// Installs a handler: the first Ctrl-C is only recorded, so that the current run can end; the
/// second ends the program at once.
void listen_for_interrupts();
bool interrupted();

}  // namespace octocell::bench
