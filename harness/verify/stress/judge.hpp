// SPDX-License-Identifier: MIT
// One implementation on one case.
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

/// From best to worst.
enum class Status : std::uint8_t { exact, skipped, refused, late, crashed, wrong };
inline constexpr std::array<std::string_view, 6> kStatusNames = {"exact", "skipped", "refused",
                                                                 "late",  "crashed", "wrong"};
constexpr std::string_view name_of(Status s) { return kStatusNames[static_cast<std::size_t>(s)]; }

struct Verdict {
  Status status = Status::exact;
  std::string reason = {};
  reference::Comparison difference = {};
  std::uint64_t pairs = 0;
  std::uint64_t candidates = 0;
};

/// What every implementation is compared with.
struct Truth {
  std::vector<Pair> pairs;  // empty where they are only counted
  std::optional<PairDigest> digest;
};

/// The oracle's pairs, or those known beforehand. Throws Error if the two differ, or if the
/// oracle's number is not the formula's: then the judge is wrong.
Truth truth_of(const Entry& entry, const Case& scene);

struct Limits {
  int threads = 1;
  std::uint64_t candidates = 0;  // of our own backends
  std::uint64_t library_candidates = 0;
  std::chrono::duration<double> library_time{10};
  int repetitions = 1;
};

/// Never throws for what the implementation does. Baselines run in processes of their own. A truth
/// that is only a number gets its checksum from the first answer, which all others must repeat.
Verdict judge(const Implementation& how, Ask ask, const Case& scene, Truth& truth,
              const Limits& limits);

}  // namespace octocell::stress
