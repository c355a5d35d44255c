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

/// A scene with all its frames (one, unless it moves) and its exact pairs.
struct Subject {
  std::string spec;
  Frames frames;
  std::vector<Flags> flags;         // of each sphere, in all frames; or empty
  std::vector<Pair> truth;          // of frames[0]
  std::vector<PairDigest> digests;  // of each frame's exact pairs
  std::optional<reference::RoundingEffect> rounding = {};  // of frames[0], from float64

  [[nodiscard]] SceneView view(std::size_t frame = 0) const { return {frames[frame], flags}; }
};

/// The results of a row so far; the fields of its JSON.
struct RowResult {
  std::optional<std::string> skipped;  // the reason, if it was skipped
  PairDigest digest;
  reference::Comparison difference;
  std::vector<std::set<std::uint64_t>> checksums;  // for each frame: all that its runs returned
  Counts counts;
  Plan plan;  // for our backends: the plan for the scene
  double plan_ms = 0.0;
  std::uint64_t iterations = 1;
  std::vector<double> total_ms;         // one per round
  std::vector<double> marked_total_ms;  // of the runs that gave stage_ms
  std::map<Stage, std::vector<double>> stage_ms;
  std::map<Stage, Stage> fused;
  std::vector<std::vector<double>> frame_ms;  // of a dynamic row: round by round, frame by frame
  std::optional<std::uint64_t> peak_bytes;    // of the host
  std::optional<std::uint64_t> device_bytes;  // of the device, at its peak

  [[nodiscard]] bool wrong() const { return !skipped && !difference.exact(); }
  /// Returns 1 if every run found the same pairs; for a row with frames, the number of the frame
  /// that varied most.
  [[nodiscard]] std::size_t distinct_checksums() const;
};

/// Runs one row: first checks whether it is right, then measures it round by round.
class RowRunner {
 public:
  RowRunner(const RowSpec& row, const Subject& subject, std::uint64_t candidate_limit);
  virtual ~RowRunner() = default;

  /// Runs once and compares the pairs with the truth; this also shows how long a run takes. A row
  /// that cannot run here is marked as skipped, with the reason.
  void verify(double min_time_ms);

  /// Runs the same in its own process, because a library may crash or never end. Returns how it
  /// ended, if not well.
  [[nodiscard]] std::optional<std::string> try_apart(std::chrono::duration<double> limit) const;
  void skip(const std::string& reason);

  /// Measures once, for this round. Then compares the pairs with the truth again.
  virtual void measure(const std::string& name) = 0;

  [[nodiscard]] const RowSpec& row() const { return row_; }
  [[nodiscard]] RowResult& result() { return result_; }
  [[nodiscard]] const RowResult& result() const { return result_; }

 protected:
  /// Throws LimitError if the row cannot run.
  virtual void verify_or_throw(double min_time_ms) = 0;

  /// Records how much device memory is in use. Call it once the pairs were found for the first
  /// time.
  void record_device_memory();
  void require_under_limit(const Counts& counts) const;
  /// Throws LimitError if there were fewer threads than the row's name says.
  void require_threads(const Counts& counts) const;
  /// Compares the finder's pairs with the exact pairs of a frame.
  void judge(std::size_t frame);
  void record_stages(const StageTimes& times);

  const RowSpec row_;
  const Subject& subject_;
  PlanOptions options_;
  std::unique_ptr<PairFinder> finder_;
  RowResult result_;

 private:
  std::uint64_t device_bytes_before_ = 0;  // held by other rows
};

std::unique_ptr<RowRunner> make_runner(const RowSpec& row, const Subject& subject,
                                       std::uint64_t candidate_limit);

}  // namespace octocell::bench
