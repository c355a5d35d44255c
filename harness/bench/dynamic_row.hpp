// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/bench/row_runner.hpp"

namespace octocell::bench {

/// The first frames only settle a structure: the first is built, and in the next few, boxes that
/// grow on contact still grow. They are reported, but not part of the steady state.
inline constexpr std::size_t kWarmupFrames = 5;

/// A scene that moves: update() announces each frame, then all pairs are found. If a backend's plan
/// no longer holds, it plans again, and that frame's time includes this.
class DynamicRow final : public RowRunner {
 public:
  DynamicRow(const RowSpec& row, const Subject& subject, std::uint64_t candidate_limit);
  void measure(const std::string& name) override;

 private:
  void verify_or_throw(double min_time_ms) override;
  /// Plays from the first frame to the last; returns the time of each.
  std::vector<StageTimes> play(Marks marks);
  StageTimes run_frame(std::size_t frame, StageClock& clock);
  bool plan_holds(const Counts& counts) const;

  Plan plan_;
};

}  // namespace octocell::bench
