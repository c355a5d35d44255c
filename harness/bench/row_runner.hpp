// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/bench/rows.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::bench {

/// A scene at all its moments (one, unless it moves), and what is right for it.
struct Subject {
  std::string spec;
  Frames frames;
  std::vector<Flags> flags;                                // of each sphere, in all frames; or none
  std::vector<Pair> truth;                                 // of frames[0]
  std::vector<PairDigest> digests;                         // of each frame's exact pairs
  std::optional<reference::RoundingEffect> rounding = {};  // of frames[0], from float64

  [[nodiscard]] SceneView view(std::size_t frame = 0) const { return {frames[frame], flags}; }
};

/// What is known of a row so far; the fields of its JSON.
struct RowResult {
  std::optional<std::string> skipped;  // why
  PairDigest digest;
  reference::Comparison difference;
  std::vector<std::set<std::uint64_t>> checksums;  // of each frame: all that its runs gave
  Counts counts;
  Plan plan;  // ours: what was decided for the scene
  double plan_ms = 0.0;
  std::uint64_t iterations = 1;
  std::vector<double> total_ms;         // one a round
  std::vector<double> marked_total_ms;  // the runs behind stage_ms
  std::map<Stage, std::vector<double>> stage_ms;
  std::map<Stage, Stage> fused;
  std::vector<std::vector<double>> frame_ms;  // of a dynamic row: round by round, frame by frame
  std::optional<std::uint64_t> peak_bytes;    // of the host's memory
  std::optional<std::uint64_t> device_bytes;  // of the device's, at its peak

  [[nodiscard]] bool wrong() const { return !skipped && !difference.exact(); }
  /// 1 if every run gave the same pairs; of a row with frames, those of the frame that varied most.
  [[nodiscard]] std::size_t distinct_checksums() const;
};

/// Runs one row: first to see whether it is right, then round by round.
class RowRunner {
 public:
  RowRunner(const RowSpec& row, const Subject& subject, std::uint64_t candidate_limit);
  virtual ~RowRunner() = default;

  /// One complete run, compared with the truth, which also shows how long a run takes. A row that
  /// cannot be run here is marked skipped, with the reason.
  void verify(double min_time_ms);

  /// The same run in a process of its own, for a library that may crash or never end: says how it
  /// ended, if it did not end well.
  [[nodiscard]] std::optional<std::string> try_apart(std::chrono::duration<double> limit) const;
  void skip(const std::string& reason);

  /// One measurement of this round. The pairs are compared with the truth again after it.
  virtual void measure(const std::string& name) = 0;

  [[nodiscard]] const RowSpec& row() const { return row_; }
  [[nodiscard]] RowResult& result() { return result_; }
  [[nodiscard]] const RowResult& result() const { return result_; }

 protected:
  /// Throws LimitError where the row cannot be run.
  virtual void verify_or_throw(double min_time_ms) = 0;

  /// To be called once the pairs were found for the first time.
  void record_device_memory();
  void require_under_limit(const Counts& counts) const;
  /// A row names its threads.
  void require_threads(const Counts& counts) const;
  /// Compares what the finder holds now with the exact pairs of a frame.
  void judge(std::size_t frame);
  void record_stages(const StageTimes& times);

  const RowSpec row_;
  const Subject& subject_;
  PlanOptions options_;
  std::unique_ptr<PairFinder> finder_;
  RowResult result_;

 private:
  std::uint64_t device_bytes_before_ = 0;  // held for other rows
};

std::unique_ptr<RowRunner> make_runner(const RowSpec& row, const Subject& subject,
                                       std::uint64_t candidate_limit);

}  // namespace octocell::bench
