// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "harness/bench/row_runner.hpp"

namespace octocell::bench {

/// Runs the same scene again and again: cold, warm, or updated in place.
class StaticRow final : public RowRunner {
 public:
  using RowRunner::RowRunner;
  void measure(const std::string& name) override;

 private:
  void verify_or_throw(double min_time_ms) override;
  StageTimes run_once(Marks marks);
  StageTimes run_cold(Marks marks);
  StageTimes run_warm(Marks marks);
  void build_untimed();
};

}  // namespace octocell::bench
