// SPDX-License-Identifier: MIT
// Time every implementation on every scene, check each row against the exact pairs, write JSON.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace octocell::bench {

struct BenchOptions {
  std::string preset = "quick";      // a name of choose_groups(); which scenes, sizes and rounds
  std::vector<std::string> scenes;   // instead of the preset's
  std::optional<std::string> flags;  // of the one scene named: a side file
  std::string motion;                // sets those scenes in motion
  std::string trajectory;            // a folder of frames, *.npy
  int frames = 20;                   // of a motion
  bool round_input = false;          // accept float64 files; say what rounding changed
  std::string backend = "all";
  std::string output = "reports/out/bench.json";
  std::string filter;         // regular expression on row names; empty: all
  std::optional<int> rounds;  // instead of the preset's
  double min_time_ms = 10.0;  // a measurement repeats short runs for at least this long
  /// A baseline is first tried in a process of its own, which may take so long.
  std::chrono::duration<double> baseline_limit{60.0};
  bool list_only = false;  // print the names of the rows and stop
  bool memory = true;      // measure peak memory, one child process a row
};

/// Takes the flags it knows out of `arguments` (Google Benchmark's --benchmark_filter,
/// --benchmark_repetitions, --benchmark_min_time, --benchmark_out, --benchmark_list_tests), and
/// hands the rest to Google Benchmark. Throws InputError for a flag that neither knows.
void take_benchmark_flags(BenchOptions& options, std::vector<std::string> arguments);

/// Returns the exit code: 0; 1 if a row that is no negative control is wrong; 130 after Ctrl-C,
/// with every finished group in the output. Throws InputError.
int run_bench(const BenchOptions& options);

/// The child process behind the memory column: finds the pairs once and prints
/// {"peak_bytes": growth of resident memory over the scene itself, "output_bytes": 8 a pair}.
struct MemoryOptions {
  std::string scene;
  std::optional<std::string> flags;  // a side file
  bool round_input = false;
  std::string row;  // Implementation::label()
  int threads = 1;
};
int run_memory_child(const MemoryOptions& options);

}  // namespace octocell::bench
