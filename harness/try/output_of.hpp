// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace octocell::hand_in {

struct Output {
  int exit_code;  // 127 if there is no such program
  bool timed_out;
  std::string text;  // both streams; at most the first 64 KiB
};

/// Runs a program without a shell and returns what it printed. Throws LimitError if no process can
/// be started.
Output output_of(const std::vector<std::string>& command, std::chrono::duration<double> limit);

}  // namespace octocell::hand_in
