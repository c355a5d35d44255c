// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/bench/bench.hpp"
#include "harness/scenes/motion.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell::bench {

/// Which rows a group has time for.
enum class Rows : std::uint8_t {
  device_default,  // the default rule on a GPU
  device,          // all that runs on a GPU
  headline,        // the same, and our default rule on the host
  fast,            // each backend's plan and home_phantom, and each library's fastest
  usual,           // all methods and rules, and the broad phases that are meant for many spheres
  every,           // those that look at nearly all pairs, too
  frames,          // plans that take over from the last frame, and the same searched again
  ablation,        // the plan with and without each skip, and each method that can be forced
  precision,       // our plans with each predicate
  error,           // the same, each library's fastest, and those that can lose pairs
};

/// Rows that are interleaved with each other: one scene at one size.
struct Group {
  std::string scene;                      // label: generator or file stem
  std::uint64_t n = 0;                    // spheres
  std::string argument;                   // for load_or_generate()
  std::optional<std::string> flags = {};  // the side file that goes with it
  bool without_flags = false;             // they say who moves, but no finder is told
  std::string unavailable = {};           // why a real scene is not there; empty if it is
  std::optional<Motion> motion = {};      // of a group that moves
  std::string trajectory = {};            // or the folder of its frames
  int frames = 1;
  bool real = false;             // a file fetched at set-up; it may be missing
  std::string scene_class = {};  // of preset error: random, structured, extreme
  bool round_input = false;      // ask what rounding from float64 changed
  int rounds = 5;
  std::optional<int> baseline_rounds = {};  // fewer of them, spread over the others
  Rows rows = Rows::every;

  [[nodiscard]] bool moves() const { return motion || !trajectory.empty(); }
  [[nodiscard]] int rounds_of(bool baseline) const {
    return baseline ? baseline_rounds.value_or(rounds) : rounds;
  }
};

/// The spheres of a group, frame by frame; one frame where nothing moves.
struct Footage {
  std::string spec;  // gives the same frames again
  Frames frames;
  std::vector<Flags> flags;  // of each sphere, in all frames; or none
  std::optional<std::vector<DoubleSphere>> unrounded = {};  // the first frame, if it was asked for
};
Footage footage_of(const Group& group);

/// The groups that the options ask for, small ones first. Scenes that the caller named are loaded
/// once to learn their sizes; a second one of the same name and size is called NAME#2. Throws
/// InputError for what cannot be had; a real scene of a preset that was not fetched is only marked
/// unavailable.
std::vector<Group> choose_groups(const BenchOptions& options);

/// Throws InputError if the results would take the place of a scene, its flags or a frame.
void require_inputs_kept(const std::vector<Group>& groups, const std::string& output);

/// More candidate pairs than this, counted beforehand, and a row is skipped with their number.
std::uint64_t candidate_limit(const BenchOptions& options);

}  // namespace octocell::bench
