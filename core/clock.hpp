// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <optional>

#include "core/stage.hpp"

namespace octocell {

/// What one find_pairs() took, in milliseconds. A stage that did not run has no time; a stage that
/// ran inside another's kernel has no time of its own and names the stage that holds it.
struct StageTimes {
  double total_ms = 0.0;
  std::array<std::optional<double>, kStageCount> stage_ms = {};
  std::array<std::optional<Stage>, kStageCount> fused_into = {};
};

/// Whether a clock takes the time of each stage, or of the whole only.
enum class Marks : bool { off, on };

/// Marks the ends of stages. The base class times nothing but the total.
class StageClock {
 public:
  virtual ~StageClock() = default;
  virtual void start() = 0;
  /// The stages first..last have just ended, in one piece of work. Never waits.
  virtual void mark(Stage first, Stage last) = 0;
  void mark(Stage stage) { mark(stage, stage); }
  /// The only call that may wait.
  virtual StageTimes stop() = 0;
};

/// Wall-clock time of the host.
class HostClock final : public StageClock {
 public:
  explicit HostClock(Marks marks = Marks::on) : marks_(marks) {}
  using StageClock::mark;

  void start() override {
    times_ = {};
    begin_ = last_ = Clock::now();
  }
  void mark(Stage first, Stage last) override {
    if (marks_ == Marks::off) return;
    const Clock::time_point now = Clock::now();
    times_.stage_ms[index_of(first)] =
        times_.stage_ms[index_of(first)].value_or(0.0) + milliseconds(now - last_);
    for (std::size_t s = index_of(first) + 1; s <= index_of(last); ++s)
      times_.fused_into[s] = first;
    last_ = now;
  }
  StageTimes stop() override {
    times_.total_ms = milliseconds(Clock::now() - begin_);
    return times_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double milliseconds(Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
  }

  Marks marks_;
  StageTimes times_;
  Clock::time_point begin_;
  Clock::time_point last_;
};

}  // namespace octocell
