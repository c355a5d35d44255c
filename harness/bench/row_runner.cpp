// SPDX-License-Identifier: MIT
#include "harness/bench/row_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "core/cuda/device_memory.hpp"
#include "core/error.hpp"
#include "harness/bench/dynamic_row.hpp"
#include "harness/bench/static_row.hpp"
#include "harness/engine/isolate.hpp"

namespace octocell::bench {

std::size_t RowResult::distinct_checksums() const {
  std::size_t most = 0;
  for (const auto& of_frame : checksums) most = std::max(most, of_frame.size());
  return most;
}

RowRunner::RowRunner(const RowSpec& row, const Subject& subject, std::uint64_t candidate_limit)
    : row_(row), subject_(subject) {
  options_ = row.how.plan_options(row.threads);
  options_.allowed = options_.allowed.both(row.allowed);
  options_.candidate_limit = candidate_limit;
  result_.checksums.resize(subject.frames.size());
}

void RowRunner::verify(double min_time_ms) {
  try {
    if (const auto reason = row_.how.backend->why_unavailable()) throw LimitError(*reason);
    device_bytes_before_ = DeviceMemory::in_use();
    DeviceMemory::forget_peak();
    verify_or_throw(min_time_ms);
  } catch (const LimitError& reason) {
    skip(reason.what());
  }
}

void RowRunner::skip(const std::string& reason) {
  result_.skipped = reason;
  finder_.reset();
}

void RowRunner::record_device_memory() {
  if (!row_.how.backend->device) return;
  result_.device_bytes = DeviceMemory::peak() - device_bytes_before_;
}

std::optional<std::string> RowRunner::try_apart(std::chrono::duration<double> limit) const {
  try {
    find_isolated(row_.how.backend->create, subject_.view(), options_, limit);
    return std::nullopt;
  } catch (const LimitError& reason) {
    return reason.what();
  }
}

void RowRunner::require_under_limit(const Counts& counts) const {
  if (!counts.over_candidate_limit) return;
  throw LimitError(fmt::format("{} candidates, over the limit of {}", counts.candidates,
                               options_.candidate_limit));
}

void RowRunner::require_threads(const Counts& counts) const {
  if (counts.threads == 0 || counts.threads >= row_.threads) return;
  throw LimitError(fmt::format("the system gave {} of {} threads", counts.threads, row_.threads));
}

void RowRunner::judge(std::size_t frame) {
  const PairDigest digest = finder_->digest();
  if (frame == 0) result_.digest = digest;
  const bool is_new = result_.checksums[frame].insert(digest.checksum).second;
  if (digest == subject_.digests[frame] || !is_new) return;
  // To show what is wrong with an answer, the exact pairs of this frame are needed.
  const std::vector<Pair> truth =
      frame == 0 ? subject_.truth : reference::exact_pairs(subject_.frames[frame], subject_.flags);
  result_.difference = reference::compare(finder_->download(), truth, subject_.frames[frame]);
}

void RowRunner::record_stages(const StageTimes& times) {
  result_.marked_total_ms.push_back(times.total_ms);
  for (std::size_t s = 0; s < kStageCount; ++s) {
    const auto stage = static_cast<Stage>(s);
    if (times.stage_ms[s]) result_.stage_ms[stage].push_back(*times.stage_ms[s]);
    if (times.fused_into[s]) result_.fused[stage] = *times.fused_into[s];
  }
}

std::unique_ptr<RowRunner> make_runner(const RowSpec& row, const Subject& subject,
                                       std::uint64_t candidate_limit) {
  if (row.run == Run::dynamic) return std::make_unique<DynamicRow>(row, subject, candidate_limit);
  return std::make_unique<StaticRow>(row, subject, candidate_limit);
}

}  // namespace octocell::bench
