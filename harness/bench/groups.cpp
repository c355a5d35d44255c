// SPDX-License-Identifier: MIT
#include "harness/bench/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/bench/presets.hpp"
#include "harness/files/frames.hpp"
#include "harness/files/input_file.hpp"
#include "harness/files/load.hpp"
#include "harness/files/named_files.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::bench {
namespace {

constexpr std::uint64_t kMotionSeed = 1;

/// Makes labels such as gas and gas#2: scenes that differ only in a seed must not share row names.
void make_labels_distinct(std::vector<Group>& groups) {
  std::map<std::pair<std::string, std::uint64_t>, int> seen;
  for (Group& group : groups) {
    const int times = ++seen[{group.scene, group.n}];
    if (times > 1) group.scene += fmt::format("#{}", times);
  }
}

/// Returns the caller's scenes, in motion if the options say so.
std::vector<Group> custom_groups(const BenchOptions& options) {
  if (options.load.flags && (options.scenes.size() != 1 || !options.trajectory.empty())) {
    throw InputError("--flags belongs to one scene: name exactly one, and no trajectory");
  }
  std::vector<Group> groups;
  for (const std::string& scene : options.scenes) {
    groups.push_back(group_of_scene(scene, options.load));
    if (options.motion.empty()) continue;
    groups.back().motion = motion_named(options.motion);
    groups.back().scene += "_" + options.motion;
    groups.back().frames = options.frames;
  }
  if (options.trajectory.empty()) return groups;
  groups.push_back(group_of_trajectory(options.trajectory, 5));
  if (!groups.back().unavailable.empty()) throw InputError(groups.back().unavailable);
  groups.back().scene = printable(std::filesystem::path(options.trajectory).filename().string());
  groups.back().real = false;
  return groups;
}

}  // namespace

Group group_of_scene(const std::string& argument, const LoadOptions& options) {
  if (argument == kStandardInput) {
    throw InputError("bench reads a scene several times, and standard input can be read once");
  }
  const Scene scene = load_or_generate(argument, options);
  for (const std::string& note : scene.notes) {
    fmt::print(stderr, "octocell: {}: {}\n", printable(argument), printable(note));
  }
  return {.scene = scene.name, .n = scene.spheres.size(), .argument = argument, .load = options};
}

Group group_of_trajectory(const std::string& folder, int rounds) {
  Group group = {.scene = "adk_trajectory",
                 .argument = folder,
                 .trajectory = folder,
                 .real = true,
                 .rounds = rounds,
                 .rows = Rows::usual};
  try {
    const Frames frames = load_trajectory(folder);
    group.n = frames.front().size();
    group.frames = static_cast<int>(frames.size());
  } catch (const InputError& missing) {
    group.unavailable = missing.what();
  }
  return group;
}

Footage footage_of(const Group& group) {
  if (!group.trajectory.empty())
    return {printable(group.trajectory), load_trajectory(group.trajectory), {}};
  Scene scene = load_or_generate(group.argument, group.load);
  if (!group.motion) {
    return {
        scene.spec, {std::move(scene.spheres)}, std::move(scene.flags), std::move(scene.unrounded)};
  }
  Frames frames = move(scene.spheres, *group.motion, group.frames, kMotionSeed, scene.flags);
  if (group.without_flags) scene.flags.clear();
  return {fmt::format("{} {} frames={}{}", scene.spec,
                      kMotionNames[static_cast<std::size_t>(*group.motion)], group.frames,
                      group.without_flags ? " without flags" : ""),
          std::move(frames), std::move(scene.flags), std::move(scene.unrounded)};
}

std::vector<Group> choose_groups(const BenchOptions& options) {
  const Preset preset = preset_named(options.preset);  // refused even if scenes take its place
  std::vector<Group> groups = custom_groups(options);
  if (groups.empty()) groups = preset();
  make_labels_distinct(groups);
  if (options.rounds) {
    for (Group& group : groups) {
      group.rounds = *options.rounds;
      if (group.baseline_rounds) {
        group.baseline_rounds = std::min(group.rounds, *group.baseline_rounds);
      }
    }
  }
  return groups;
}

void require_inputs_kept(const std::vector<Group>& groups, const std::string& output) {
  NamedFiles files;
  for (const Group& group : groups) {
    if (!group.unavailable.empty()) continue;
    files.read_scene(group.argument, group.load.flags);
    if (group.trajectory.empty()) continue;
    for (std::string& frame : frame_files(group.trajectory))
      files.read("a frame", std::move(frame));
  }
  files.write("--output", output);
  files.require_separate();
}

std::uint64_t candidate_limit(const BenchOptions& options) {
  return options.preset == "full" ? 100'000'000'000 : 3'000'000'000;
}

}  // namespace octocell::bench
