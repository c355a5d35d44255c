// SPDX-License-Identifier: MIT
// The border of the library: whatever is thrown inside leaves it as Error.
#pragma once

namespace octocell::library {

/// Throws what is being caught as an Error.
[[noreturn]] void throw_as_error();

/// Calls `work` and returns its result.
template <typename Work>
auto with_errors(const Work& work) {
  try {
    return work();
  } catch (...) {
    throw_as_error();
  }
}

}  // namespace octocell::library
