// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace octocell::cli {

/// What main() runs after parsing: the chosen command; returns the exit code.
using Command = std::function<int()>;

/// Each adds its subcommand to the application; when it is chosen, `command` is set.
void add_list(CLI::App& app, Command& command);
void add_find(CLI::App& app, Command& command);
void add_explain(CLI::App& app, Command& command);
void add_generate(CLI::App& app, Command& command);

/// Those below, which need FCL, Bullet, GMP and Google Benchmark; or, in a build without, their
/// names and why they are missing.
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
