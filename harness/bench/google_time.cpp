// SPDX-License-Identifier: MIT
#include "harness/bench/google_time.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace octocell::bench {
namespace {

/// Reads the time of one benchmark, and prints nothing.
class OneTime final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) milliseconds = run.GetAdjustedRealTime();
  }
  double milliseconds = 0.0;
};

}  // namespace

double average_ms(const std::string& name, std::uint64_t iterations,
                  const std::function<double()>& run_ms) {
  benchmark::ClearRegisteredBenchmarks();
  benchmark::RegisterBenchmark(name.c_str(),
                               [&run_ms](benchmark::State& state) {
                                 for ([[maybe_unused]] auto _ : state) {
                                   state.SetIterationTime(run_ms() / 1e3);
                                 }
                               })
      ->UseManualTime()
      ->Iterations(static_cast<benchmark::IterationCount>(iterations))
      ->Unit(benchmark::kMillisecond);
  OneTime time;
  benchmark::RunSpecifiedBenchmarks(&time, nullptr, ".");
  return time.milliseconds;
}

}  // namespace octocell::bench
