// SPDX-License-Identifier: MIT
#include "harness/bench/presets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "harness/files/load.hpp"
#include "harness/files/real_scenes.hpp"

namespace octocell::bench {
namespace {

constexpr std::string_view kMolecule = "data/1A2C.pqr";
constexpr std::string_view kTrajectory = "data/adk_frames";
constexpr const char* kScenes[] = {"gas",     "dense",   "poly", "cluster",
                                   "lattice", "shifted", "giant"};

void add(std::vector<Group>& groups, std::string_view scene, std::uint64_t n, int rounds,
         Rows rows) {
  groups.push_back({.scene = std::string(scene),
                    .n = n,
                    .argument = fmt::format("{}:n={},seed=1", scene, n),
                    .rounds = rounds,
                    .rows = rows});
}

/// Returns the group of the molecule, which may not have been downloaded at set-up.
Group molecule(int rounds) {
  Group group = {.scene = "1A2C",
                 .argument = std::string(kMolecule),
                 .real = true,
                 .rounds = rounds,
                 .rows = Rows::every};
  try {
    group.n = load_or_generate(group.argument).spheres.size();
  } catch (const InputError& missing) {
    group.unavailable = missing.what();
  }
  return group;
}

/// Returns a group for a preset's generator with parameters, which its label shows:
/// poly(ratio=1e6).
Group special(std::string_view argument, int rounds, Rows rows) {
  Group group = group_of_scene(std::string(argument));
  group.scene = argument.substr(0, argument.find(':'));
  const std::size_t comma = argument.find(',');
  if (comma != std::string_view::npos) {
    group.scene += fmt::format("({})", argument.substr(comma + 1));
  }
  group.rounds = rounds;
  group.rows = rows;
  return group;
}

/// Adds a gas that moves.
void add_motion(std::vector<Group>& groups, Motion motion, std::uint64_t n, int frames,
                int rounds) {
  add(groups, "gas", n, rounds, n <= 1'000 ? Rows::every : n <= 10'000 ? Rows::usual : Rows::fast);
  groups.back().scene = fmt::format("gas_{}", kMotionNames[static_cast<std::size_t>(motion)]);
  groups.back().motion = motion;
  groups.back().frames = frames;
}

/// Adds a million moving spheres, to show what a frame reuses from the last.
void add_frames(std::vector<Group>& groups, Motion motion, int frames, int rounds) {
  add_motion(groups, motion, 1'000'000, frames, rounds);
  groups.back().rows = Rows::frames;
}

/// Adds the same, with flags that make nine of ten spheres static.
void add_static(std::vector<Group>& groups, Motion motion, int frames, int rounds) {
  add_frames(groups, motion, frames, rounds);
  groups.back().scene += "_static";
  groups.back().argument += ",static=0.9";
}

/// Real scenes, as far as they were downloaded.
std::vector<Group> real_groups() {
  std::vector<Group> groups;
  for (const RealScene& real : real_scenes()) {
    groups.push_back({.scene = std::string(real.name),
                      .argument = std::string(real.path),
                      .real = true,
                      .rounds = 5,
                      .rows = Rows::usual});
    if (is_there(real)) {
      groups.back().n = real.spheres;
    } else {
      groups.back().unavailable = fmt::format("{}: not there; make real downloads it", real.path);
    }
  }
  std::ranges::stable_sort(groups, {}, &Group::n);
  return groups;
}

std::vector<Group> quick_groups() {
  std::vector<Group> groups;
  for (const auto scene : kScenes) add(groups, scene, 1'000, 3, Rows::every);
  for (const auto scene : kScenes) add(groups, scene, 10'000, 3, Rows::usual);
  groups.push_back(molecule(3));
  for (const auto scene : kScenes) add(groups, scene, 100'000, 3, Rows::fast);
  add_motion(groups, Motion::brownian, 1'000, 12, 3);
  add_motion(groups, Motion::brownian, 10'000, 12, 3);
  add_motion(groups, Motion::brownian, 100'000, 10, 2);
  add(groups, "gas", 1'000'000, 3, Rows::fast);
  return groups;
}

std::vector<Group> full_groups() {
  std::vector<Group> groups;
  groups.push_back(molecule(11));
  for (const std::uint64_t n : {1'000ULL, 10'000ULL, 100'000ULL, 1'000'000ULL}) {
    for (const auto scene : kScenes) {
      add(groups, scene, n,
          n < 100'000     ? 11
          : n < 1'000'000 ? 7
                          : 5,
          n < 100'000 ? Rows::every : Rows::usual);
    }
  }
  for (const std::uint64_t n : {1'000ULL, 10'000ULL, 100'000ULL, 1'000'000ULL}) {
    for (const Motion motion : {Motion::brownian, Motion::free_fall, Motion::gravity}) {
      add_motion(groups, motion, n, n < 1'000'000 ? 30 : 12, 3);
    }
  }
  for (const Motion motion : {Motion::slow, Motion::few, Motion::still}) {
    for (const std::uint64_t n : {100'000ULL, 1'000'000ULL}) add_motion(groups, motion, n, 30, 3);
  }
  groups.push_back(group_of_trajectory(std::string(kTrajectory), 3));
  return groups;
}

/// For a machine with a GPU: time against size, every scene at a million spheres, frames.
std::vector<Group> gpu_groups() {
  constexpr int kRounds = 21;
  std::vector<Group> groups;
  for (const std::uint64_t n : {10'000ULL, 100'000ULL, 1'000'000ULL}) {
    add(groups, "gas", n, kRounds, Rows::headline);
  }
  for (const std::uint64_t n : {3'000'000ULL, 10'000'000ULL, 30'000'000ULL}) {
    add(groups, "gas", n, kRounds, Rows::device_default);
  }
  for (const auto scene : kScenes) {
    if (std::string_view(scene) != "gas") add(groups, scene, 1'000'000, kRounds, Rows::device);
  }
  add_motion(groups, Motion::brownian, 1'000'000, 12, 3);
  groups.back().rows = Rows::headline;
  for (const Motion motion : {Motion::still, Motion::slow}) add_frames(groups, motion, 12, 3);
  for (const Motion motion : {Motion::brownian, Motion::slow}) add_static(groups, motion, 12, 3);
  return groups;
}

/// Times of a frame that may reuse data from the last; for scenes with flags, also without them.
std::vector<Group> frames_groups() {
  constexpr int kFrames = 44;  // enough for neighbor lists to begin and end
  constexpr int kRounds = 5;
  std::vector<Group> groups;
  for (const Motion motion : {Motion::still, Motion::slow, Motion::few, Motion::darts,
                              Motion::brownian, Motion::gravity}) {
    add_frames(groups, motion, kFrames, kRounds);
  }
  add_static(groups, Motion::brownian, kFrames, kRounds);
  groups.push_back(groups.back());
  groups.back().scene += "_without_flags";
  groups.back().without_flags = true;
  return groups;
}

/// Every scene, and some for which a plain grid is far too slow.
std::vector<Group> ablation_groups() {
  constexpr int kRounds = 41;
  constexpr std::string_view kHard[] = {"discs:n=100000",
                                        "chain:n=100000",
                                        "poly:n=100000,ratio=1e6",
                                        "shifted:n=100000,offset=1e7",
                                        "lattice:n=100000,shuffle=1",
                                        "gas:n=100000,phi=1e-4"};
  std::vector<Group> groups;
  for (const std::uint64_t n : {100ULL, 10'000ULL}) add(groups, "gas", n, kRounds, Rows::ablation);
  for (const auto scene : kScenes) add(groups, scene, 100'000, kRounds, Rows::ablation);
  for (const auto scene : kHard) groups.push_back(special(scene, kRounds, Rows::ablation));
  return groups;
}

/// Run time against error: scenes without structure, scenes full of ties, and scenes of extreme
/// numbers. Some are small because libraries that lose pairs would not finish large ones in time.
std::vector<Group> error_groups() {
  constexpr int kRounds = 41;
  constexpr int kBaselineRounds = 5;
  constexpr std::pair<std::string_view, std::string_view> kClassesAndScenes[] = {
      {"random", "gas:n=100000"},
      {"random", "dense:n=100000"},
      {"random", "poly:n=100000"},
      {"random", "cluster:n=100000"},
      {"structured", "lattice:n=10000"},
      {"structured", "lattice:n=100000"},
      {"structured", "lattice:n=100000,spacing=0.1"},
      {"structured", "fcc:n=100000"},
      {"structured", "chain:n=10000"},
      {"extreme", "shifted:n=100000,offset=1e4"},
      {"extreme", "shifted:n=10000,offset=1e7"},
      {"extreme", "shifted:n=100000,offset=1e7"},
      {"extreme", "giant:n=100000"},
      {"extreme", "poly:n=100000,ratio=1e6"}};
  constexpr std::pair<std::string_view, std::string_view> kLarge[] = {
      {"random", "gas:n=1000000"},
      {"random", "dense:n=1000000"},
      {"random", "poly:n=1000000"},
      {"random", "cluster:n=1000000"},
      {"structured", "lattice:n=1000000,shuffle=1"}};
  std::vector<Group> groups;
  for (const auto& [scene_class, scene] : kClassesAndScenes) {
    groups.push_back(special(scene, kRounds, Rows::error));
    groups.back().scene_class = scene_class;
    groups.back().load.round_input = true;
    groups.back().baseline_rounds = kBaselineRounds;
  }
  for (const auto& [scene_class, scene] : kLarge) {
    groups.push_back(special(scene, kRounds, Rows::precision));
    groups.back().scene_class = scene_class;
  }
  return groups;
}

constexpr std::pair<std::string_view, Preset> kPresets[] = {
    {"quick", quick_groups},   {"full", full_groups},         {"gpu", gpu_groups},
    {"frames", frames_groups}, {"ablation", ablation_groups}, {"error", error_groups},
    {"real", real_groups}};

}  // namespace

Preset preset_named(std::string_view name) {
  std::string known;
  for (const auto& [preset, groups] : kPresets) {
    if (preset == name) return groups;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", preset);
  }
  throw InputError(fmt::format("unknown preset '{}'; known: {}", name, known));
}

}  // namespace octocell::bench
