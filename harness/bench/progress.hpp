// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace octocell::bench {

/// Prints "[17/96] impl_cpu home_phantom lowest_cell gas n=100000 cold, about 2 min left" on
/// stderr. On a terminal, it overwrites one line; elsewhere it prints a line every few seconds.
class Progress {
 public:
  /// A step is one row of one group with its check and all its rounds, or the work before the rows.
  struct Step {
    std::string label;  // of the implementation; times of one size help to predict the next
    double spheres;
    double passes;                     // how many runs the step will need
    double seconds_per_sphere = 5e-7;  // of one pass: a guess until two sizes were seen
  };
  explicit Progress(std::vector<Step> steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t step, std::string_view what);
  void note(std::string_view line);
  /// Notes the time that a step has taken so far; `share` of it is done.
  void learn(std::size_t step, double seconds, double share);
  [[nodiscard]] double seconds_left() const;

 private:
  /// The time of a pass over that many spheres.
  struct Seen {
    double spheres;
    double seconds;
  };
  /// Small scenes show what a pass of any size costs (a process is started, short runs are
  /// repeated); large ones show what a sphere costs.
  struct Sizes {
    Seen smallest;
    Seen largest;
  };
  [[nodiscard]] double seconds_of_pass(const Step& step) const;

  std::vector<Step> steps_;
  std::vector<double> done_;           // share of each step
  std::map<std::string, Sizes> seen_;  // by label
  std::chrono::steady_clock::time_point last_shown_ = {};
  bool terminal_;
  bool line_open_ = false;
};

}  // namespace octocell::bench
