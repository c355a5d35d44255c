// SPDX-License-Identifier: MIT
// The bench predicts how long it will take. It must not conclude from small groups that large ones
// take as long per sphere.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/bench/progress.hpp"

namespace octocell::bench {
namespace {

/// A pass of any size costs 30 ms, and so much a sphere.
struct Pace {
  std::string label;
  double seconds_per_sphere;
  double guess;
};
constexpr double kSecondsOfPass = 0.03;
constexpr double kPasses = 8.0;

double seconds_of(const Progress::Step& step, const Pace& pace) {
  return step.passes * (kSecondsOfPass + pace.seconds_per_sphere * step.spheres);
}

TEST(Progress, EstimatesLargeGroupsWhileSmallOnesRun) {
  const std::vector<Pace> paces = {
      {"ours", 2e-8, 5e-8}, {"thrust", 2e-7, 5e-8}, {"fcl", 1e-6, 1e-6}};
  const std::vector<double> sizes = {1e3, 1e3, 1e3, 1e3, 1e4, 1e4, 1e5, 1e5, 1e6};
  std::vector<Progress::Step> steps;
  for (const double size : sizes) {
    for (const Pace& pace : paces) steps.push_back({pace.label, size, kPasses, pace.guess});
  }
  Progress progress(steps);
  double left = 0.0;
  for (std::size_t s = 0; s < steps.size(); ++s)
    left += seconds_of(steps[s], paces[s % paces.size()]);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const double seconds = seconds_of(steps[s], paces[s % paces.size()]);
    progress.learn(s, seconds / 2.0, 0.5);
    progress.learn(s, seconds / 2.0, 1.0);
    left -= seconds;
    if (s < paces.size()) continue;  // each implementation was seen once
    EXPECT_LE(progress.seconds_left(), 2.0 * left + 1e-6) << s;
    EXPECT_GE(progress.seconds_left(), 0.5 * left - 1e-6) << s;
  }
  EXPECT_NEAR(progress.seconds_left(), 0.0, 1e-6);
}

}  // namespace
}  // namespace octocell::bench
