// SPDX-License-Identifier: MIT
#include "harness/cli/endings.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/cli/commands.hpp"

namespace octocell::cli {
namespace {

bool is_leaving = false;

void at_exit() {
  if (is_leaving) return;
  std::fflush(nullptr);
  _exit(kExitBadInput);  // the library has already printed the reason
}

[[noreturn]] void at_terminate() {
  if (std::current_exception()) {
    complain_of_exception();
  } else {
    complain("ended without a reason", kExitBadInput);
  }
  std::fflush(nullptr);
  _exit(kExitBadInput);
}

}  // namespace

int complain(std::string_view what, int exit_code) {
  fmt::print(stderr, "octocell: {}\n", printable(what));
  return exit_code;
}

int complain_of_exception() {
  try {
    throw;
  } catch (const Error& error) {
    return complain(error.what(), kExitBadInput);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory for this scene", kExitBadInput);
  } catch (const std::exception& error) {
    // Long output fails while it is written, with fmt's message, not at the end.
    return std::ferror(stdout) != 0 ? complain_of_output() : complain(error.what(), kExitBadInput);
  } catch (...) {
    return complain("ended by an unknown exception", kExitBadInput);
  }
}

int complain_of_output() {
  return complain("standard output: could not be written", kExitBadInput);
}

void keep_promised_exit_codes() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(at_terminate);
  std::atexit(at_exit);
}

int leave(int exit_code) {
  is_leaving = true;
  return exit_code;
}

}  // namespace octocell::cli
