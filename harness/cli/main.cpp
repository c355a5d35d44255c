// SPDX-License-Identifier: MIT
// The command line. Every failure is one line on stderr and a non-zero exit code.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/endings.hpp"

namespace {

using namespace octocell;

int require_output(int exit_code) {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return exit_code;
  return cli::complain_of_output();
}

/// Describes an error. CLI11 only says that a command is missing; this adds which word is not a
/// command.
std::string describe(const CLI::ParseError& error, const CLI::App& app, int argc, char** argv) {
  const bool names_a_command = argc > 1 && argv[1][0] != '-';
  if (error.get_name() != "RequiredError" || !names_a_command) return error.what();
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  std::vector<std::string> known;
  for (const CLI::App* command : commands) {
    if (command->get_name() == argv[1]) return error.what();
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  return fmt::format("unknown command '{}'; known: {}", argv[1], fmt::join(known, ", "));
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Octocell: every overlapping pair of spheres, exactly", "octocell"};
  app.set_version_flag("--version", OCTOCELL_VERSION);
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Help for all commands");

  cli::Command command;
  cli::add_commands(app, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return require_output(app.exit(asked_for_help));
  } catch (const CLI::ParseError& error) {
    return cli::complain(describe(error, app, argc, argv), cli::kExitBadInput);
  }
  return require_output(command());
}

int run(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (...) {
    return cli::complain_of_exception();
  }
}

}  // namespace

int main(int argc, char** argv) {
  octocell::cli::keep_promised_exit_codes();
  return octocell::cli::leave(run(argc, argv));
}
