// SPDX-License-Identifier: MIT
// Judges one implementation on one case.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/engine/registry.hpp"
#include "harness/verify/reference/reference.hpp"
#include "harness/verify/stress/catalogue.hpp"

namespace octocell::stress {

/// Ordered from best to worst.
enum class Status : std::uint8_t { exact, skipped, refused, late, crashed, wrong };
inline constexpr std::array<std::string_view, 6> kStatusNames = {"exact", "skipped", "refused",
                                                                 "late",  "crashed", "wrong"};
constexpr std::string_view name_of(Status s) { return kStatusNames[static_cast<std::size_t>(s)]; }

struct CaseVerdict {
  Status status = Status::exact;
  std::string reason = {};
  reference::Comparison difference = {};
  std::uint64_t pairs = 0;
  std::uint64_t candidates = 0;
};

/// The truth that every implementation is compared with.
struct Truth {
  std::vector<Pair> pairs;  // empty if pairs are only counted
  std::optional<PairDigest> digest;
};

/// Returns the reference's pairs, or those known beforehand. Throws Error if the two differ, or if
/// the reference's number of pairs differs from the formula's: then the judge is wrong.
Truth truth_of(const Entry& entry, const Case& scene);

struct Limits {
  int threads = 1;
  std::uint64_t candidates = 0;  // for our own backends
  std::uint64_t library_candidates = 0;
  std::chrono::duration<double> library_time{10};
  int repetitions = 1;
};

/// Judges an implementation; never throws for what it does. Baselines run in processes of their
/// own. If the truth is only a number, the first answer sets its checksum, and all others must
/// repeat that.
CaseVerdict judge(const Implementation& how, Ask ask, const Case& scene, Truth& truth,
                  const Limits& limits);

}  // namespace octocell::stress
