// SPDX-License-Identifier: MIT
#include <memory>

#include "harness/bench/sort/sort_bench.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"

namespace octocell::cli {

void add_bench_sort(CLI::App& sub, Command& command) {
  auto o = std::make_shared<bench::SortBenchOptions>();
  auto threads = std::make_shared<int>(0);
  sub.description("Time our radix sorts and those of libraries");
  sub.add_option("--preset", o->preset, "quick (a minute, default) or full (an hour)");
  sub.add_option("--rounds", o->rounds, "Rounds of each case")->check(CLI::Range(1, 1000000));
  sub.add_option("--device", o->device, "Rows on cpu, gpu or all (default)");
  sub.add_option("--threads", *threads,
                 "Threads for rows with several threads; 0 means all (default)");
  sub.add_option("--filter", o->filter, "Only rows whose names match (regular expression)");
  sub.add_option("-o,--output", o->output, "JSON to write (default reports/out/sort.json)");
  sub.callback([&command, o, threads] {
    o->threads = thread_count(*threads);
    command = [o] { return bench::run_sort_bench(*o); };
  });
}

}  // namespace octocell::cli
