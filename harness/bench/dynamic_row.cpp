// SPDX-License-Identifier: MIT
#include "harness/bench/dynamic_row.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/bench/google_time.hpp"
#include "harness/engine/median.hpp"

namespace octocell::bench {
namespace {

/// Returns the median of the frames after the warm-up (of all frames, if there are no others).
double steady_median(const std::vector<double>& frames) {
  const std::size_t skipped = frames.size() > kWarmupFrames ? kWarmupFrames : 0;
  return median({frames.begin() + static_cast<std::ptrdiff_t>(skipped), frames.end()});
}

}  // namespace

DynamicRow::DynamicRow(const RowSpec& row, const Subject& subject, std::uint64_t candidate_limit)
    : RowRunner(row, subject, candidate_limit) {
  options_.moving = true;
}

bool DynamicRow::plan_holds(const Counts& counts) const {
  return !counts.plan_violation && fits(counts, plan_.capacity, plan_.count_only);
}

StageTimes DynamicRow::run_frame(std::size_t frame, StageClock& clock) {
  const SceneView scene = subject_.view(frame);
  if (frame > 0) finder_->update(scene);
  finder_->find_pairs(clock);
  StageTimes times = clock.stop();
  const Counts counts = finder_->counts();
  require_under_limit(counts);
  require_threads(counts);
  if (plan_holds(counts)) return times;
  HostClock again(Marks::off);
  again.start();
  const Outcome outcome = complete(*finder_, scene, plan_scene(scene, options_), clock);
  plan_ = outcome.plan;
  times.total_ms += again.stop().total_ms;
  return times;
}

std::vector<StageTimes> DynamicRow::play(Marks marks) {
  plan_ = plan_scene(subject_.view(), options_);
  finder_->upload(plan_, subject_.view());
  std::vector<StageTimes> times;
  const std::unique_ptr<StageClock> clock = finder_->make_clock(marks);
  for (std::size_t frame = 0; frame < subject_.frames.size(); ++frame) {
    times.push_back(run_frame(frame, *clock));
    judge(frame);
  }
  return times;
}

void DynamicRow::verify_or_throw(double) {
  finder_ = row_.how.backend->create();
  const std::vector<StageTimes> times = play(Marks::on);
  record_device_memory();
  result_.counts = finder_->counts();
  result_.plan = plan_;
  for (std::size_t frame = std::min(kWarmupFrames, times.size() - 1); frame < times.size();
       ++frame) {
    record_stages(times[frame]);
  }
}

void DynamicRow::measure(const std::string& name) {
  std::vector<double> frame_ms;
  average_ms(name, 1, [&] {
    double total_ms = 0.0;
    for (const StageTimes& times : play(Marks::off)) {
      frame_ms.push_back(times.total_ms);
      total_ms += times.total_ms;
    }
    return total_ms;
  });
  result_.total_ms.push_back(steady_median(frame_ms));
  result_.frame_ms.push_back(std::move(frame_ms));
}

}  // namespace octocell::bench
