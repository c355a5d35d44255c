// SPDX-License-Identifier: MIT
#include "harness/bench/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace octocell::bench {
namespace {

constexpr std::chrono::seconds kBetweenLines{3};

std::string in_words(double seconds) {
  if (seconds < 10.0) return "a few seconds left";
  if (seconds < 90.0) return fmt::format("about {:.0f} s left", std::ceil(seconds / 10.0) * 10.0);
  return fmt::format("about {:.0f} min left", std::ceil(seconds / 60.0));
}

}  // namespace

Progress::Progress(std::vector<Step> steps)
    : steps_(std::move(steps)), done_(steps_.size(), 0.0), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (line_open_) std::fputs("\n", stderr);
}

/// Returns a point on the line through the sizes seen so far; with only one size, its slope is the
/// guess.
double Progress::seconds_of_pass(const Step& step) const {
  const auto known = seen_.find(step.label);
  if (known == seen_.end()) return step.spheres * step.seconds_per_sphere;
  const auto& [smallest, largest] = known->second;
  const double size = largest.spheres - smallest.spheres;
  const double slope = size > 0.0
                           ? std::max(0.0, (largest.seconds - smallest.seconds) / size)
                           : std::min(step.seconds_per_sphere, smallest.seconds / smallest.spheres);
  return std::max(0.0, largest.seconds + slope * (step.spheres - largest.spheres));
}

double Progress::seconds_left() const {
  double seconds = 0.0;
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    if (done_[s] == 1.0) continue;
    seconds += (1.0 - done_[s]) * steps_[s].passes * seconds_of_pass(steps_[s]);
  }
  return seconds;
}

void Progress::learn(std::size_t step, double seconds, double share) {
  const Step& what = steps_[step];
  const double gained = share - done_[step];
  done_[step] = share;
  if (gained <= 0.0 || what.spheres == 0.0) return;
  const Seen now = {what.spheres, seconds / (gained * what.passes)};
  Sizes& sizes = seen_.try_emplace(what.label, Sizes{now, now}).first->second;
  if (now.spheres <= sizes.smallest.spheres) sizes.smallest = now;
  if (now.spheres >= sizes.largest.spheres) sizes.largest = now;
}

void Progress::show(std::size_t step, std::string_view what) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ && now - last_shown_ < kBetweenLines) return;
  last_shown_ = now;
  const std::string line =
      fmt::format("[{}/{}] {}, {}", step + 1, steps_.size(), what, in_words(seconds_left()));
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\x1b[K" : "", line, terminal_ ? "" : "\n");
  std::fflush(stderr);
  line_open_ = terminal_;
}

void Progress::note(std::string_view line) {
  fmt::print(stderr, "{}{}\n", line_open_ ? "\r\x1b[K" : "", line);
  line_open_ = false;
}

}  // namespace octocell::bench
