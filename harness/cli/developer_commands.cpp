// SPDX-License-Identifier: MIT
#include "harness/cli/commands.hpp"

namespace octocell::cli {

void add_developer_commands(CLI::App& app, Command& command) {
  add_check(app, command);
  add_bench(app, command);
  add_bench_sort(app, command);
  add_stress(app, command);
  add_near_tangent(app, command);
}

}  // namespace octocell::cli
