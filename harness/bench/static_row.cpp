// SPDX-License-Identifier: MIT
#include "harness/bench/static_row.hpp"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "harness/bench/google_time.hpp"

namespace octocell::bench {
namespace {

constexpr double kMaxIterations = 1000.0;

}  // namespace

void StaticRow::verify_or_throw(double min_time_ms) {
  finder_ = row_.how.backend->create();
  const Outcome outcome = find_completely(*finder_, subject_.view(), options_);
  record_device_memory();
  result_.counts = outcome.counts;
  result_.plan_ms = outcome.plan_ms;
  result_.plan = outcome.plan;
  require_under_limit(outcome.counts);
  require_threads(outcome.counts);
  judge(0);
  if (row_.run == Run::cold) finder_.reset();
  HostClock whole(Marks::off);
  whole.start();
  run_once(Marks::off);
  const double expected_ms = whole.stop().total_ms;  // includes the untimed set-up
  result_.iterations = static_cast<std::uint64_t>(
      std::clamp(std::ceil(min_time_ms / std::max(expected_ms, 1e-3)), 1.0, kMaxIterations));
}

StageTimes StaticRow::run_cold(Marks marks) {
  finder_.reset();
  malloc_trim(0);  // returns memory that earlier rows freed, so that every row starts with
                   // untouched pages
  HostClock whole(Marks::off);
  whole.start();
  finder_ = row_.how.backend->create();
  const std::unique_ptr<StageClock> inner = finder_->make_clock(marks);
  const Plan plan = plan_scene(subject_.view(), options_);
  const Outcome outcome = complete(*finder_, subject_.view(), plan, *inner);
  StageTimes times = outcome.times;
  times.total_ms = whole.stop().total_ms;
  return times;
}

void StaticRow::build_untimed() {
  HostClock unread(Marks::off);
  finder_->find_pairs(unread);
}

StageTimes StaticRow::run_warm(Marks marks) {
  const std::unique_ptr<StageClock> clock = finder_->make_clock(marks);
  finder_->find_pairs(*clock);
  return clock->stop();
}

StageTimes StaticRow::run_once(Marks marks) {
  switch (row_.run) {
    case Run::cold:
      return run_cold(marks);
    case Run::graph:
      return {.total_ms = finder_->device_runs()->replay_ms()};
    case Run::transfers:
      return {.total_ms = finder_->device_runs()->transfers_ms()};
    case Run::cold_cache:
      finder_->device_runs()->flush_cache();
      return run_warm(marks);
    case Run::first_update:
      build_untimed();
      [[fallthrough]];
    case Run::update:
      finder_->update(subject_.view());
      [[fallthrough]];
    case Run::warm:
    case Run::dynamic:
      break;
  }
  return run_warm(marks);
}

void StaticRow::measure(const std::string& name) {
  result_.total_ms.push_back(
      average_ms(name, result_.iterations, [this] { return run_once(Marks::off).total_ms; }));
  judge(0);
  // A cold run of a baseline takes long; a single one with marks is enough to show its stages.
  if (has_stage_times(row_.run) && (row_.run != Run::cold || result_.stage_ms.empty())) {
    record_stages(run_once(Marks::on));
  }
  if (row_.run == Run::cold) finder_.reset();
}

}  // namespace octocell::bench
