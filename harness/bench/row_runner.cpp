// SPDX-License-Identifier: MIT
#include "harness/bench/row_runner.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>

#include "harness/interface/error.hpp"

namespace octocell::bench {
namespace {

constexpr double kMaxIterations = 1000.0;

/// Takes the time of one benchmark, and prints nothing.
class OneTime final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) milliseconds = run.GetAdjustedRealTime();
  }
  double milliseconds = 0.0;
};

}  // namespace

RowRunner::RowRunner(const RowSpec& row, const Subject& subject, std::uint64_t candidate_limit)
    : row_(row), subject_(subject) {
  options_ = row.how.plan_options(row.threads);
  options_.candidate_limit = candidate_limit;
}

void RowRunner::verify(double min_time_ms) {
  try {
    if (const auto reason = row_.how.backend->why_unavailable()) throw LimitError(*reason);
    finder_ = row_.how.backend->create();
    const Outcome outcome = find_completely(*finder_, subject_.scene, options_);
    plan_ = outcome.plan;
    result_.counts = outcome.counts;
    result_.plan_ms = outcome.plan_ms;
    if (outcome.counts.over_candidate_limit) {
      throw LimitError(fmt::format("{} candidates, over the limit of {}", outcome.counts.candidates,
                                   options_.candidate_limit));
    }
    result_.digest = finder_->digest();
    result_.difference = reference::compare(finder_->download(), subject_.truth);
  } catch (const LimitError& reason) {
    result_.skipped = reason.what();
    finder_.reset();
    return;
  }
  if (row_.run == Run::cold) finder_.reset();
  expected_ms_ = run_once(HostClock::Marks::off).total_ms;
  result_.iterations = static_cast<std::uint64_t>(
      std::clamp(std::ceil(min_time_ms / std::max(expected_ms_, 1e-3)), 1.0, kMaxIterations));
}

StageTimes RowRunner::run_cold(HostClock::Marks marks) {
  finder_.reset();
  malloc_trim(0);  // what earlier rows freed goes back, so that every row meets untouched pages
  HostClock whole(HostClock::Marks::off);
  HostClock inner(marks);
  whole.start();
  finder_ = row_.how.backend->create();
  const Plan plan = plan_scene(subject_.scene, options_);
  const Outcome outcome = complete(*finder_, subject_.scene, plan, inner);
  StageTimes times = outcome.times;
  times.total_ms = whole.stop().total_ms;
  return times;
}

void RowRunner::build_untimed() {
  HostClock unread(HostClock::Marks::off);
  finder_->find_pairs(unread);
}

StageTimes RowRunner::run_once(HostClock::Marks marks) {
  if (row_.run == Run::cold) return run_cold(marks);
  if (row_.run == Run::first_update) build_untimed();
  if (row_.run != Run::warm) finder_->update(subject_.scene);
  HostClock clock(marks);
  finder_->find_pairs(clock);
  return clock.stop();
}

void RowRunner::check_digest() {
  if (finder_->digest() == result_.digest) return;
  // Another answer than the verified one: compare again, so that the row shows what is wrong.
  result_.digest = finder_->digest();
  result_.difference = reference::compare(finder_->download(), subject_.truth);
}

void RowRunner::record_stages(const StageTimes& times) {
  result_.marked_total_ms.push_back(times.total_ms);
  for (std::size_t s = 0; s < kStageCount; ++s) {
    const auto stage = static_cast<Stage>(s);
    if (times.stage_ms[s]) result_.stage_ms[stage].push_back(*times.stage_ms[s]);
    if (times.fused_into[s]) result_.fused[stage] = *times.fused_into[s];
  }
}

void RowRunner::measure(const std::string& name) {
  benchmark::ClearRegisteredBenchmarks();
  benchmark::RegisterBenchmark(
      name.c_str(),
      [this](benchmark::State& state) {
        for ([[maybe_unused]] auto _ : state) {
          state.SetIterationTime(run_once(HostClock::Marks::off).total_ms / 1e3);
        }
      })
      ->UseManualTime()
      ->Iterations(static_cast<benchmark::IterationCount>(result_.iterations))
      ->Unit(benchmark::kMillisecond);
  OneTime time;
  benchmark::RunSpecifiedBenchmarks(&time, nullptr, ".");
  result_.total_ms.push_back(time.milliseconds);
  check_digest();
  // A cold run of a baseline takes long; one with marks is enough to show its stages.
  if (row_.run != Run::cold || result_.stage_ms.empty()) {
    record_stages(run_once(HostClock::Marks::on));
  }
  if (row_.run == Run::cold) finder_.reset();
}

}  // namespace octocell::bench
