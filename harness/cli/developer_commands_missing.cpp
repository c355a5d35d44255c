// SPDX-License-Identifier: MIT
// For a build with OCTOCELL_DEVELOPER=OFF: the names are known, but only report why they are
// missing.
#include <fmt/format.h>

#include <string>

#include "core/error.hpp"
#include "harness/cli/commands.hpp"

namespace octocell::cli {

void add_developer_commands(CLI::App& app, Command& command) {
  for (const std::string name : {"check", "bench", "bench-sort", "stress", "near-tangent"}) {
    CLI::App* sub = app.add_subcommand(name, "Not in this build (OCTOCELL_DEVELOPER=OFF)");
    sub->allow_extras();
    sub->callback([&command, name] {
      command = [name]() -> int {
        throw LimitError(fmt::format("{}: not in this build (OCTOCELL_DEVELOPER=OFF)", name));
      };
    });
  }
}

}  // namespace octocell::cli
