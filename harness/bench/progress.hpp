// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace octocell::bench {

/// "[17/96] impl_cpu home_phantom lowest_cell gas n=100000 cold, about 2 min left", on stderr.
/// On a terminal one line that is overwritten; elsewhere a line every few seconds.
class Progress {
 public:
  /// A step is one row of one group, its check and all its rounds; or what is done before them.
  struct Step {
    std::string label;  // of the implementation: what is learnt from one size serves the next
    double spheres;
    double passes;                     // runs that the step will take
    double seconds_per_sphere = 5e-7;  // of one pass: a guess, until a step of that label was seen
  };
  explicit Progress(std::vector<Step> steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t step, std::string_view what);
  void note(std::string_view line);
  /// What a step has cost so far; `share` of it is done.
  void learn(std::size_t step, double seconds, double share);

 private:
  [[nodiscard]] double seconds_left() const;

  std::vector<Step> steps_;
  std::vector<double> done_;                          // share of each step
  std::map<std::string, double> seconds_per_sphere_;  // of one pass, latest seen
  std::chrono::steady_clock::time_point last_shown_ = {};
  bool terminal_;
  bool line_open_ = false;
};

}  // namespace octocell::bench
