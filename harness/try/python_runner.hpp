// SPDX-License-Identifier: MIT
#pragma once

namespace octocell::hand_in {

/// The text of python_runner.py, for python3 -c.
extern const char* const kPythonRunner;

}  // namespace octocell::hand_in
