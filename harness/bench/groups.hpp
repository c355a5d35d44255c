// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/bench/bench.hpp"
#include "harness/files/load_options.hpp"
#include "harness/scenes/motion.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell::bench {

/// Which rows a group has time for.
enum class Rows : std::uint8_t {
  device_default,  // the default rule on a GPU
  device,          // everything that runs on a GPU
  headline,        // the same, and our default rule on the host
  fast,            // each backend's plan and home_phantom, and the fastest baseline of each library
  usual,           // all methods and rules, and the baselines that are meant for many spheres
  every,           // also the baselines that compare nearly all pairs
  frames,          // plans that reuse data from the last frame, and the same plans without reuse
  ablation,        // the plan with and without each skip, and each method that can be forced
  precision,       // our plans with each predicate
  error,           // the same, the fastest baseline of each library, and those that can lose pairs
};

/// Rows that are interleaved: one scene at one size.
struct Group {
  std::string scene;                  // label: generator or file stem
  std::uint64_t n = 0;                // spheres
  std::string argument;               // for load_or_generate()
  LoadOptions load = {};              // for load_or_generate()
  bool without_flags = false;         // flags decide which spheres move, but no finder gets them
  std::string unavailable = {};       // why a real scene is missing; empty if it is not
  std::optional<Motion> motion = {};  // if the group moves
  std::string trajectory = {};        // or the folder with its frames
  int frames = 1;
  bool real = false;             // a downloaded file, which may be missing
  std::string scene_class = {};  // for preset error: random, structured, extreme
  int rounds = 5;
  std::optional<int> baseline_rounds = {};  // fewer rounds for baselines, spread over the others
  Rows rows = Rows::every;

  [[nodiscard]] bool moves() const { return motion || !trajectory.empty(); }
  [[nodiscard]] int rounds_of(bool baseline) const {
    return baseline ? baseline_rounds.value_or(rounds) : rounds;
  }
};

/// Returns the group of one scene, loaded once to learn its size.
Group group_of_scene(const std::string& argument, const LoadOptions& options = {});

/// Returns the group of a folder of frames, which is marked unavailable if they cannot be loaded.
Group group_of_trajectory(const std::string& folder, int rounds);

/// The spheres of a group, frame by frame; a single frame if nothing moves.
struct Footage {
  std::string spec;  // makes the same frames again
  Frames frames;
  std::vector<Flags> flags;  // of each sphere, in all frames; or empty
  std::optional<std::vector<DoubleSphere>> unrounded = {};  // of the first frame, if requested
};
Footage footage_of(const Group& group);

/// Returns the groups that the options choose, small ones first. Loads scenes that the caller named
/// once, to learn their sizes; a second one of the same name and size is called NAME#2. Throws
/// InputError for what cannot be loaded. A real scene of a preset that was not downloaded is only
/// marked unavailable.
std::vector<Group> choose_groups(const BenchOptions& options);

/// Throws InputError if the results would overwrite a scene, its flags or a frame.
void require_inputs_kept(const std::vector<Group>& groups, const std::string& output);

/// Returns the most candidate pairs. If more are counted beforehand, a row is skipped with their
/// number.
std::uint64_t candidate_limit(const BenchOptions& options);

}  // namespace octocell::bench
