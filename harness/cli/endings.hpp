// SPDX-License-Identifier: MIT
// Exit codes mean what docs/command_line.md says, however the program ends.
#pragma once

#include <string_view>

namespace octocell::cli {

/// Prints "octocell: WHAT" on stderr, on one line; names in it are made printable. Returns the exit
/// code.
int complain(std::string_view what, int exit_code);

/// Once, at the start: from now on, a library that calls exit() (OpenMP does where it gets no
/// thread) and an exception that is not caught (in a thread) end with a line and exit code 2, and
/// a file that grows beyond the user's limit (SIGXFSZ) is an error like a full disk.
void keep_promised_exit_codes();

/// At the end of main(): the exit that follows is ours.
int leave(int exit_code);

}  // namespace octocell::cli
