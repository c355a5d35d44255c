// SPDX-License-Identifier: MIT
#include "harness/cli/commands.hpp"

#include <fmt/format.h>

#include <string>

#include "core/error.hpp"

namespace octocell::cli {
namespace {

struct NamedCommand {
  const char* name;
  void (*add)(CLI::App& sub, Command& command);  // null: not in this build
};

#ifdef OCTOCELL_DEVELOPER
#define OCTOCELL_UNLESS_USERS_BUILD(add) add
#else
#define OCTOCELL_UNLESS_USERS_BUILD(add) nullptr
#endif

/// In the order of --help.
constexpr NamedCommand kCommands[] = {
    {"list", add_list},
    {"find", add_find},
    {"explain", add_explain},
    {"why", add_why},
    {"trace", add_trace},
    {"generate", add_generate},
    {"judge", OCTOCELL_UNLESS_USERS_BUILD(add_judge)},
    {"try", OCTOCELL_UNLESS_USERS_BUILD(add_try)},
    {"check", OCTOCELL_UNLESS_USERS_BUILD(add_check)},
    {"bench", OCTOCELL_UNLESS_USERS_BUILD(add_bench)},
    {"bench-sort", OCTOCELL_UNLESS_USERS_BUILD(add_bench_sort)},
    {"stress", OCTOCELL_UNLESS_USERS_BUILD(add_stress)},
    {"near-tangent", OCTOCELL_UNLESS_USERS_BUILD(add_near_tangent)},
#ifdef OCTOCELL_DEVELOPER
    {"run-hand-in", add_run_hand_in},
#endif
};

/// Makes the name known, so that the error says why it cannot be used.
void add_missing(CLI::App& sub, Command& command) {
  sub.description("Not in this build (OCTOCELL_DEVELOPER=OFF)");
  sub.allow_extras();
  sub.callback([&command, name = sub.get_name()] {
    command = [name]() -> int {
      throw LimitError(fmt::format("{}: not in this build (OCTOCELL_DEVELOPER=OFF)", name));
    };
  });
}

}  // namespace

void add_commands(CLI::App& app, Command& command) {
  for (const NamedCommand& named : kCommands) {
    CLI::App& sub = *app.add_subcommand(named.name);
    (named.add != nullptr ? named.add : add_missing)(sub, command);
  }
}

}  // namespace octocell::cli
