// SPDX-License-Identifier: MIT
// Tries a hand-in on one scene after the other, and stops at the first that is wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/judge/judge.hpp"
#include "harness/try/bench.hpp"
#include "harness/try/judge_stage.hpp"
#include "harness/try/protocol.hpp"
#include "harness/try/trial_scenes.hpp"

namespace octocell::hand_in {

struct Options {
  std::string file;
  Function function = Function::find_pairs;  // or a stage
  std::string python = "python3";
  double budget_s = 20.0;   // for larger scenes
  double timeout_s = 10.0;  // for one scene
  double memory_gib = 4.0;
  std::size_t seed = 1;
  bool sanitize = false;  // run with the sanitizers of C++ or CUDA
  bool bench = false;     // if exact, time it
  std::string save;       // where to write the first wrong scene; empty: nowhere
};

struct TriedScene {
  std::string spec;     // "no spheres", or of a generator
  std::uint64_t n;      // spheres, or entries that a stage reads
  std::uint64_t found;  // true pairs, or what else the function should write
  bool exact;
  double milliseconds;  // from the question to the whole answer; no benchmark
  Part part;
};

struct Trial {
  Function function;
  std::string verdict;      // exact, wrong, cannot be judged
  std::string kind = {};    // why it cannot be judged: crashed, hangs, ...
  std::string reason = {};  // a line
  std::vector<std::string> compiled_with = {};
  std::string printed = {};  // the end of what it printed, if it cannot be judged
  std::vector<TriedScene> scenes = {};
  std::string at = {};                         // the scene at which it ended
  std::optional<judge::Judgement> wrong = {};  // of the last scene
  std::optional<WrongEntry> wrong_entry = {};  // the same for a stage that writes no pairs
  std::optional<judge::Cause> cause = {};      // of that, or of a larger scene
  std::string cause_at = {};                   // which
  std::vector<Sphere> wrong_spheres = {};      // the last scene
  Part part = Part::small;                     // in which it ended
  std::vector<TimedScene> timed = {};

  [[nodiscard]] bool is_wrong() const { return wrong || wrong_entry; }
};

/// Never throws for what the hand-in does. Throws InputError for a file that cannot be one.
Trial try_hand_in(const Options& options);

std::string to_text(const Trial& trial, std::string_view file);
nlohmann::ordered_json to_json(const Trial& trial, std::string_view file);

}  // namespace octocell::hand_in
