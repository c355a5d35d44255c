// SPDX-License-Identifier: MIT
// Times our radix sort and the sorts of libraries, checks every answer, writes JSON.
#pragma once

#include <optional>
#include <string>

namespace octocell::bench {

struct SortBenchOptions {
  std::string preset = "quick";  // quick or full: sizes, widths, orders and rounds
  std::string filter;            // regular expression on row names; empty: all
  std::string output = "reports/out/sort.json";
  std::optional<int> rounds;  // instead of the preset's
  std::string device =
      "all";        // cpu, gpu or all: whose rows; all leaves out a gpu that is not there
  int threads = 1;  // for the rows with several threads
};

/// Returns the exit code: 0; 1 if a row is wrong; 130 after Ctrl-C, with every finished case in the
/// output. Throws InputError.
int run_sort_bench(const SortBenchOptions& options);

}  // namespace octocell::bench
