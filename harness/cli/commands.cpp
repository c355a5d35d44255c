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
#define OCTOCELL_IF_DEVELOPER(add) add
#else
#define OCTOCELL_IF_DEVELOPER(add) nullptr
#endif
#ifdef OCTOCELL_JUDGE
#define OCTOCELL_IF_JUDGE(add) add
#else
#define OCTOCELL_IF_JUDGE(add) nullptr
#endif

/// In the order of --help.
constexpr NamedCommand kCommands[] = {
    {"list", add_list},
    {"find", add_find},
    {"explain", add_explain},
    {"why", add_why},
    {"trace", add_trace},
    {"generate", add_generate},
    {"judge", OCTOCELL_IF_JUDGE(add_judge)},
    {"try", OCTOCELL_IF_JUDGE(add_try)},
    {"doctor", OCTOCELL_IF_JUDGE(add_doctor)},
    {"check", OCTOCELL_IF_DEVELOPER(add_check)},
    {"bench", OCTOCELL_IF_DEVELOPER(add_bench)},
    {"bench-sort", OCTOCELL_IF_DEVELOPER(add_bench_sort)},
    {"stress", OCTOCELL_IF_DEVELOPER(add_stress)},
    {"near-tangent", OCTOCELL_IF_DEVELOPER(add_near_tangent)},
#ifdef OCTOCELL_JUDGE
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
