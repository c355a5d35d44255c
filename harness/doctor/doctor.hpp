// SPDX-License-Identifier: MIT
// What this machine has, what it lacks, and the command that mends each.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace octocell::doctor {

/// Something that a hand-in may need.
struct Check {
  std::string name;
  bool here;
  std::string found;      // what is here, or why it does not serve
  std::string mend = {};  // a command or a line of advice; empty if there is nothing to mend
};

/// A language of hand-ins, tried with a hand-in that is right.
struct Way {
  std::string name;
  std::string command;  // what the user types
  bool works;
  std::string reason = {};    // why it does not
  std::string compiler = {};  // with which its sample was compiled; empty if none was
  bool needs_a_gpu = false;
};

struct Report {
  std::vector<Check> checks;
  std::vector<Way> ways;
  /// Returns whether all ways work that need no GPU.
  [[nodiscard]] bool is_well() const;
};

/// Looks at everything; takes a few seconds. `python` is the interpreter of .py files.
Report examine(const std::string& python);

std::string to_text(const Report& report);
nlohmann::ordered_json to_json(const Report& report);

}  // namespace octocell::doctor
