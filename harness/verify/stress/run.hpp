// SPDX-License-Identifier: MIT
// Runs an entry of the catalogue on all implementations: one row each, for the table and the JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/verify/stress/judge.hpp"

namespace octocell::stress {

/// The results of one implementation on all cases of an entry.
struct EntryResult {
  const Entry* entry;
  Implementation how;
  std::array<std::uint64_t, kStatusNames.size()> cases = {};  // by status
  reference::Comparison difference = {};                      // summed over the cases
  std::uint64_t spheres = 0;                                  // in the largest case
  std::uint64_t pairs = 0;                                    // found in all cases
  std::uint64_t candidates = 0;
  double seconds = 0.0;
  Status worst = Status::exact;  // over all cases
  std::string worst_case = {};   // the first with that status, and the reason
  std::string reason = {};

  [[nodiscard]] std::uint64_t with(Status s) const { return cases[static_cast<std::size_t>(s)]; }
  /// Returns the worst status; but skipped only if all cases were.
  [[nodiscard]] Status status() const;
  /// Returns true if a promise of ours is broken; libraries never fail, their results are only
  /// recorded.
  [[nodiscard]] bool failed() const;
};

/// Runs every case of an entry, if it has cases. Throws Error if the reference contradicts a
/// formula or a relation. Calls `stop` between cases, and ends if it returns true.
std::vector<EntryResult> run_entry(const Entry& entry, Size size,
                                   std::span<const Implementation> judged, const Limits& limits,
                                   bool (*stop)());

nlohmann::ordered_json to_json(const EntryResult& row);

/// {"id", "name", "asks", "sizes", "not_run"}
nlohmann::ordered_json to_json(const Entry& entry);

}  // namespace octocell::stress
