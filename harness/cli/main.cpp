// SPDX-License-Identifier: MIT
// The command line. Every failure is one line on stderr and a non-zero exit code.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <iostream>
#include <new>

#include "harness/cli/commands.hpp"
#include "harness/interface/error.hpp"

namespace {

using namespace octocell;

/// One line, whatever names the caller chose: line breaks and the like are shown, not obeyed.
int complain(std::string_view what, int exit_code) {
  std::string line;
  for (const char c : what) {
    const auto code = static_cast<unsigned char>(c);
    line += code < 0x20 || code == 0x7f ? fmt::format("\\x{:02x}", code) : std::string(1, c);
  }
  fmt::print(stderr, "octocell: {}\n", line);
  return exit_code;
}

int complain_of_output() {
  return complain("standard output: could not be written", cli::kExitBadInput);
}

int require_output(int exit_code) {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return exit_code;
  return complain_of_output();
}

/// CLI11 says only that a command is missing; this says which word is none.
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
  cli::add_list(app, command);
  cli::add_find(app, command);
  cli::add_explain(app, command);
  cli::add_calibrate(app, command);
  cli::add_check(app, command);
  cli::add_generate(app, command);
  cli::add_bench(app, command);
  cli::add_bench_sort(app, command);
  cli::add_stress(app, command);
  cli::add_near_ties(app, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return require_output(app.exit(asked_for_help));
  } catch (const CLI::ParseError& error) {
    return complain(describe(error, app, argc, argv), cli::kExitBadInput);
  }
  return require_output(command());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const octocell::Error& error) {
    return complain(error.what(), octocell::cli::kExitBadInput);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory for this scene", octocell::cli::kExitBadInput);
  } catch (const std::exception& error) {
    // Long output fails on the way, in fmt's words, not at the end.
    if (std::ferror(stdout) != 0) return complain_of_output();
    return complain(error.what(), octocell::cli::kExitBadInput);
  }
}
