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
#include "harness/engine/images/find_images.hpp"
#include "include/octocell/octocell.hpp"

namespace octocell::library {

/// Returns the backend of a device, whether it can be used or not.
const BackendInfo& backend_of(Device device);

/// Returns what the planner is given for these options. Throws InputError if `threads` is out of
/// range, and Error `unavailable` if the device is.
PlanOptions plan_options_of(const Options& options);

/// Returns what is asked of images; without a box, space does not repeat.
images::Question question_of(SceneView scene, const std::optional<Box>& box, double cutoff);

class Search {
 public:
  /// The caller may change `how` before the first run. Flags of `options` are not read.
  explicit Search(const Options& options);

  /// Finds all pairs, from scratch. Spheres and flags must stay valid until the next run.
  void run(SceneView scene);

  /// Finds all pairs of a sphere of one set with one of another.
  void run_between(std::span<const Sphere> spheres, std::span<const Sphere> others);

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
  /// Returns their shifts; none without a box.
  [[nodiscard]] std::span<const Shift> shifts() const;
  OwnedPairs take();
  /// Returns the pairs as the user gets them, with their shifts.
  Pairs handed_over();
  [[nodiscard]] std::uint64_t count();
  /// Returns true if the options have a box, a cutoff or batches.
  [[nodiscard]] bool has_images() const { return box_ || cutoff_ != 0.0 || !batch.empty(); }

  PlanOptions how;
  std::span<const std::uint32_t> batch;  // of the options, or a copy of it

 private:
  void run_open(SceneView scene, const PlanOptions& options);
  void run_images(const images::Question& question);

  bool is_sorted_;
  std::optional<Box> box_;
  double cutoff_;
  std::unique_ptr<PairFinder> finder_;
  std::unique_ptr<StageClock> clock_;
  std::optional<Plan> plan_;  // of the last frame; none if its run failed
  bool has_answer_ = false;
  bool answer_is_of_images_ = false;
  std::vector<Sphere> both_;  // sets
  std::optional<images::ImageFinder> images_;
  images::ImagePairs image_pairs_;  // of the last run
};

/// Returns the pairs as the user gets them, with their shifts if they have some.
Pairs handed_over(OwnedPairs pairs, Buffer<Shift> shifts = {});

}  // namespace octocell::library
