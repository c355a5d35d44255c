// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace octocell::cli {

/// The chosen command, which main() runs after parsing; returns the exit code.
using Command = std::function<int()>;

/// Adds all commands to the application.
void add_commands(CLI::App& app, Command& command);

/// Each function describes its command and its options. If the user chooses it, `command` is set.
void add_list(CLI::App& sub, Command& command);
void add_find(CLI::App& sub, Command& command);
void add_explain(CLI::App& sub, Command& command);
void add_why(CLI::App& sub, Command& command);
void add_trace(CLI::App& sub, Command& command);
void add_generate(CLI::App& sub, Command& command);
// Not in a build without GMP:
void add_judge(CLI::App& sub, Command& command);
void add_try(CLI::App& sub, Command& command);
void add_run_hand_in(CLI::App& sub, Command& command);
void add_doctor(CLI::App& sub, Command& command);
// Not in a build without FCL, Bullet and Google Benchmark:
void add_check(CLI::App& sub, Command& command);
void add_bench(CLI::App& sub, Command& command);
void add_bench_sort(CLI::App& sub, Command& command);
void add_stress(CLI::App& sub, Command& command);
void add_near_tangent(CLI::App& sub, Command& command);

inline constexpr int kExitWrongAnswer = 1;
inline constexpr int kExitLacking = 1;  // doctor: a way without CUDA does not work
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitInterrupted = 130;

}  // namespace octocell::cli
