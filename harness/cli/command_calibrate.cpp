// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/cli/commands.hpp"
#include "harness/driver/complete.hpp"
#include "harness/driver/median.hpp"
#include "harness/registry/calibration.hpp"
#include "harness/registry/registry.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::cli {
namespace {

constexpr int kRounds = 9;
constexpr const char* kScenes[] = {"gas:n=100000", "dense:n=100000", "cluster:n=100000"};
constexpr const char* kFewSpheres = "gas:n=1000";  // brute_force is at home there

/// Median time of a run that has warm buffers / what the model expects.
double measured_to_expected(const BackendInfo& backend, Method method, const char* spec) {
  const Scene scene = generate(spec);
  const PlanOptions options = {.method = method, .costs = backend.costs};
  const SceneStats stats = measure(scene.view());
  const std::unique_ptr<PairFinder> finder = backend.create();
  const Plan plan = find_completely(*finder, scene.view(), options).plan;
  const std::unique_ptr<StageClock> clock = finder->make_clock(Marks::off);
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    finder->find_pairs(*clock);
    times.push_back(clock->stop().total_ms);
  }
  return median(times) * 1e6 / estimate_cost(stats, plan, backend.costs);
}

double median_over_scenes(const BackendInfo& backend, Method method) {
  std::vector<double> factors;
  for (const char* const scene : kScenes) {
    factors.push_back(measured_to_expected(backend, method, scene));
  }
  return median(factors);
}

int calibrate() {
  std::map<std::string, Calibration> found;
  for (const BackendInfo& backend : backends()) {
    if (backend.kind != Kind::backend || backend.why_unavailable()) continue;
    const Calibration factors = {
        .home_phantom = median_over_scenes(backend, Method::home_phantom),
        .half_shell = median_over_scenes(backend, Method::half_shell),
        .brute_force = measured_to_expected(backend, Method::brute_force, kFewSpheres)};
    fmt::print(
        "{:<18} measured / expected: home_phantom {:.2f}, half_shell {:.2f}, brute_force {:.2f}\n",
        backend.name, factors.home_phantom, factors.half_shell, factors.brute_force);
    std::fflush(stdout);
    found[std::string(backend.name)] = factors;
  }
  store(found);
  fmt::print("{}\n", calibration_file().string());
  return 0;
}

}  // namespace

void add_calibrate(CLI::App& app, Command& command) {
  CLI::App* sub = app.add_subcommand(
      "calibrate", "Measure what work costs here, and store it for the planner (seconds)");
  sub->callback([&command] { command = calibrate; });
}

}  // namespace octocell::cli
