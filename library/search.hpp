// SPDX-License-Identifier: MIT
// What all functions of the library stand on: a backend with the options of the user.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/finder.hpp"
#include "core/planner/planner.hpp"
#include "harness/engine/backend_info.hpp"
#include "include/octocell/octocell.hpp"

namespace octocell::library {

/// Returns the backend of a device, whether it can be used or not.
const BackendInfo& backend_of(Device device);

/// Returns what the planner is given for these options. Throws InputError if `threads` is out of
/// range, and Error `unavailable` if the device is.
PlanOptions plan_options_of(const Options& options);

class Search {
 public:
  /// The caller may change `how` before the first run. Flags of `options` are not read.
  explicit Search(const Options& options);

  /// Finds all pairs, from scratch. Spheres and flags must stay valid until the next run.
  void run(SceneView scene);

  /// Finds all pairs of the next frame; `how.moving` must be true. Replans if the scene no longer
  /// fits the plan.
  void run_frame(SceneView scene);

  /// How many pairs a bounded run found, and for how many it had room. If more were found, then at
  /// least so many, and none can be had.
  struct Bounded {
    std::uint64_t found = 0;
    std::uint64_t room = 0;
  };
  /// Does the same as run(), with a list of pairs that does not grow.
  Bounded run_bounded(SceneView scene, std::uint64_t most_pairs);

  /// Returns the pairs of the last run, in the order that the options ask for.
  std::span<const Pair> pairs();
  OwnedPairs take();
  [[nodiscard]] std::uint64_t count() { return finder_->digest().count; }

  PlanOptions how;

 private:
  bool is_sorted_;
  std::unique_ptr<PairFinder> finder_;
  std::unique_ptr<StageClock> clock_;
  std::optional<Plan> plan_;  // of the last frame; none if its run failed
  bool has_answer_ = false;
};

/// Returns the pairs as the user gets them.
Pairs handed_over(OwnedPairs pairs);

}  // namespace octocell::library
