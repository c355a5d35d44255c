// SPDX-License-Identifier: MIT
// Times every implementation on every scene, compares each row with the exact pairs, writes JSON.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "harness/files/load_options.hpp"

namespace octocell::bench {

struct BenchOptions {
  std::string preset = "quick";     // a name of choose_groups(): scenes, sizes and rounds
  std::vector<std::string> scenes;  // instead of the preset's
  LoadOptions load;                 // for these scenes; flags belong to exactly one
  std::string motion;               // sets those scenes in motion
  std::string trajectory;           // a folder of frames, *.npy
  int frames = 20;                  // for a motion
  std::string backend = "all";
  std::string output = "reports/out/bench.json";
  std::string filter;         // regular expression on row names; empty: all
  std::optional<int> rounds;  // instead of the preset's
  double min_time_ms = 10.0;  // a measurement repeats short runs for at least this long
  /// A baseline is first tried in a process of its own, which may take this long.
  std::chrono::duration<double> baseline_limit{60.0};
  bool list_only = false;  // prints the names of the rows and stops
  bool memory = true;      // measures peak memory, with one child process per row
};

/// Takes the flags that it knows out of `arguments` (Google Benchmark's --benchmark_filter,
/// --benchmark_repetitions, --benchmark_min_time, --benchmark_out, --benchmark_list_tests), and
/// passes the rest to Google Benchmark. Throws InputError for a flag that neither knows.
void take_benchmark_flags(BenchOptions& options, std::vector<std::string> arguments);

/// Returns the exit code: 0; 1 if a row that is no negative control is wrong; 130 after Ctrl-C,
/// with every finished group in the output. Throws InputError.
int run_bench(const BenchOptions& options);

/// The child process that measures the memory column: it finds the pairs once and prints
/// {"peak_bytes": growth of resident memory beyond the scene itself, "output_bytes": 8 a pair}.
struct MemoryOptions {
  std::string scene;
  LoadOptions load;
  std::string row;  // Implementation::label()
  int threads = 1;
};
int run_memory_child(const MemoryOptions& options);

}  // namespace octocell::bench
