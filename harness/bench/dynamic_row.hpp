// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/bench/row_runner.hpp"

namespace octocell::bench {

/// Frames that only settle a structure: the first is built, and boxes that grow on contact grow in
/// the next few. They are reported, and left out of the steady state.
inline constexpr std::size_t kWarmupFrames = 5;

/// A scene that moves: each frame is announced by update(), then all pairs are found. A backend
/// whose plan no longer holds plans again, in that frame's time.
class DynamicRow final : public RowRunner {
 public:
  DynamicRow(const RowSpec& row, const Subject& subject, std::uint64_t candidate_limit);
  void measure(const std::string& name) override;

 private:
  void verify_or_throw(double min_time_ms) override;
  /// From the first frame to the last; returns the time of each.
  std::vector<StageTimes> play(Marks marks);
  StageTimes run_frame(std::size_t frame, StageClock& clock);
  bool plan_holds(const Counts& counts) const;

  Plan plan_;
};

}  // namespace octocell::bench
