// SPDX-License-Identifier: MIT
// Makes exit codes mean what docs/command_line.md says, however the program ends.
#pragma once

#include <string_view>

namespace octocell::cli {

/// Prints "octocell: WHAT" on one line on stderr, with unprintable characters escaped. Returns the
/// exit code.
int complain(std::string_view what, int exit_code);
/// Complains about the exception that is being handled.
int complain_of_exception();
/// Complains that standard output could not be written.
int complain_of_output();

/// Call this once, at the start. From then on, these end with a line and exit code 2: a library
/// that calls exit() (OpenMP does if it gets no thread), and an exception that is not caught (in a
/// thread). A file that grows beyond the user's limit (SIGXFSZ) is then an error like a full disk.
void keep_promised_exit_codes();

/// Call this at the end of main(): marks the following exit as our own.
int leave(int exit_code);

}  // namespace octocell::cli
