// SPDX-License-Identifier: MIT
// From a hand-in to the command that runs it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/try/protocol.hpp"

namespace octocell::hand_in {

/// A folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// How a hand-in is run.
struct Program {
  std::vector<std::string> compiled_with;  // words; empty if nothing was compiled
  std::vector<std::string> command;        // the process to start
  std::vector<std::string> reads = {};     // files that it must be able to read, whoever it is
  bool may_change_user = false;
};

/// Compiles the file if its suffix (.cpp, .cu) asks for that; .so and .py are taken as they are.
/// The program defines `function`; `python` is the interpreter. Throws InputError for a file that
/// is not there or has another suffix, and CannotJudge if it does not compile or there is no
/// compiler.
Program prepare_program(const std::string& file, Function function, const std::string& python,
                        bool sanitize, const TemporaryFolder& folder);

}  // namespace octocell::hand_in
