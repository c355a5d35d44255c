// SPDX-License-Identifier: MIT
// An entry of the catalogue over all implementations: one row each, for the table and the JSON.
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

/// All cases of an entry by one implementation.
struct Row {
  const Entry* entry;
  Implementation how;
  std::array<std::uint64_t, kStatusNames.size()> cases = {};  // by status
  reference::Comparison difference = {};                      // summed over the cases
  std::uint64_t spheres = 0;                                  // of the largest case
  std::uint64_t pairs = 0;                                    // found, in all cases
  std::uint64_t candidates = 0;
  double seconds = 0.0;
  Status worst = Status::exact;  // of all cases
  std::string worst_case = {};   // the first that ended so, and why
  std::string reason = {};

  [[nodiscard]] std::uint64_t with(Status s) const { return cases[static_cast<std::size_t>(s)]; }
  /// The worst that happened; but skipped only if all were.
  [[nodiscard]] Status status() const;
  /// A promise of ours is broken; what libraries do is recorded and no failure.
  [[nodiscard]] bool failed() const;
};

/// Runs every case of an entry that has some. Throws Error if the oracle contradicts a formula or
/// a relation. `stop` is asked between cases.
std::vector<Row> run_entry(const Entry& entry, Size size, std::span<const Implementation> judged,
                           const Limits& limits, bool (*stop)());

nlohmann::ordered_json to_json(const Row& row);

/// {"id", "name", "asks", "sizes", "not_run"}
nlohmann::ordered_json to_json(const Entry& entry);

}  // namespace octocell::stress
