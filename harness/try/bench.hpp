// SPDX-License-Identifier: MIT
// Times a hand-in beside Octocell's own methods and the libraries, on scenes that it has never
// seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace octocell::hand_in {

struct Program;
struct Options;
struct Trial;

struct TimedRow {
  std::string name;                       // "mine", or a backend with its method
  std::vector<double> milliseconds = {};  // one for each seed
  std::string ended = {};                 // why it was not timed to the end; empty if it was
};

/// One kind of scene at one size; each iteration has other spheres.
struct TimedScene {
  std::string kind;
  std::uint64_t n;
  std::vector<TimedRow> rows;
};

/// Times as long as the budget lasts. A wrong answer goes into the trial and ends it. Throws
/// CannotJudge.
std::vector<TimedScene> bench(const Program& program, const Options& options, Trial& trial);

std::string to_text(const std::vector<TimedScene>& scenes);
nlohmann::ordered_json to_json(const std::vector<TimedScene>& scenes);

}  // namespace octocell::hand_in
