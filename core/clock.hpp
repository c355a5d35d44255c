// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <optional>

#include "core/stage.hpp"

namespace octocell {

/// The times of one find_pairs(), in milliseconds. A stage that did not run has no time. A stage
/// that ran inside another stage's kernel has no time of its own and names that stage.
struct StageTimes {
  double total_ms = 0.0;
  std::array<std::optional<double>, kStageCount> stage_ms = {};
  std::array<std::optional<Stage>, kStageCount> fused_into = {};
};

/// Whether a clock times each stage, or only the total.
enum class Marks : bool { off, on };

/// Marks the ends of stages.
class StageClock {
 public:
  virtual ~StageClock() = default;
  virtual void start() = 0;
  /// Notes that the stages first..last have just ended, in one piece of work. Must not wait.
  virtual void mark(Stage first, Stage last) = 0;
  void mark(Stage stage) { mark(stage, stage); }
  /// Returns the times. The only call that may wait.
  virtual StageTimes stop() = 0;
};

/// Measures the host's wall-clock time.
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
