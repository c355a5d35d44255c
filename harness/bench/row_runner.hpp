// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/bench/rows.hpp"
#include "harness/driver/complete.hpp"
#include "harness/reference/reference.hpp"

namespace octocell::bench {

/// A scene and what is right for it.
struct Subject {
  std::string spec;
  SceneView scene;
  std::vector<Pair> truth;
  PairDigest digest;
};

/// What is known of a row so far; the fields of its JSON.
struct RowResult {
  std::optional<std::string> skipped;  // why
  PairDigest digest;
  reference::Comparison difference;
  Counts counts;
  double plan_ms = 0.0;
  std::uint64_t iterations = 1;
  std::vector<double> total_ms;         // one a round
  std::vector<double> marked_total_ms;  // the runs behind stage_ms
  std::map<Stage, std::vector<double>> stage_ms;
  std::map<Stage, Stage> fused;
  std::optional<std::uint64_t> peak_bytes;

  [[nodiscard]] bool wrong() const { return !skipped && !difference.exact(); }
};

/// Runs one row: first to see whether it is right, then round by round.
class RowRunner {
 public:
  RowRunner(const RowSpec& row, const Subject& subject, std::uint64_t candidate_limit);

  /// One complete run, compared with the truth pair by pair. Estimates the time of a run.
  void verify(double min_time_ms);

  /// One measurement by Google Benchmark, then one run with stage marks. The pairs are compared
  /// with the verified ones (count and checksum) after it.
  void measure(const std::string& name);

  [[nodiscard]] const RowSpec& row() const { return row_; }
  [[nodiscard]] RowResult& result() { return result_; }
  [[nodiscard]] const RowResult& result() const { return result_; }
  [[nodiscard]] double expected_ms() const { return expected_ms_; }

 private:
  StageTimes run_once(HostClock::Marks marks);
  void build_untimed();
  StageTimes run_cold(HostClock::Marks marks);
  void check_digest();
  void record_stages(const StageTimes& times);

  RowSpec row_;
  const Subject& subject_;
  PlanOptions options_;
  Plan plan_;  // large enough, after verify()
  std::unique_ptr<PairFinder> finder_;
  RowResult result_;
  double expected_ms_ = 0.0;
};

}  // namespace octocell::bench
