// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace octocell::cli {

/// The chosen command, which main() runs after parsing; returns the exit code.
using Command = std::function<int()>;

/// Each function adds its subcommand to the application. If the user chooses it, `command` is set.
void add_list(CLI::App& app, Command& command);
void add_find(CLI::App& app, Command& command);
void add_explain(CLI::App& app, Command& command);
void add_why(CLI::App& app, Command& command);
void add_generate(CLI::App& app, Command& command);

/// Adds the commands below, which need FCL, Bullet, GMP and Google Benchmark. A build without these
/// adds their names and the reason why they are missing.
void add_developer_commands(CLI::App& app, Command& command);
void add_check(CLI::App& app, Command& command);
void add_bench(CLI::App& app, Command& command);
void add_bench_sort(CLI::App& app, Command& command);
void add_stress(CLI::App& app, Command& command);
void add_near_tangent(CLI::App& app, Command& command);

inline constexpr int kExitWrongAnswer = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitInterrupted = 130;

}  // namespace octocell::cli
