// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace octocell::hand_in {

/// In the process of a hand-in: loads the shared library and answers questions until there are no
/// more. `function` is one of kFunctionNames. Returns the exit code.
int run_library(const std::string& path, const std::string& function);

}  // namespace octocell::hand_in
