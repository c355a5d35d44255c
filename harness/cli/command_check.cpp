// SPDX-License-Identifier: MIT
#include <fmt/color.h>
#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/driver/complete.hpp"
#include "harness/reference/reference.hpp"
#include "harness/registry/registry.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::string backend = "all";
  int threads = 0;
  double candidate_limit = 2e10;
};

constexpr std::string_view kDefaultSize = ":n=2000";

enum class Grade : std::uint8_t { exact, wrong, exhibit, skipped };

struct Verdict {
  Grade grade;
  std::string text;
};

struct Limits {
  int threads;
  std::uint64_t candidates;
};

Verdict judge(const Implementation& how, const reference::Comparison& difference) {
  if (difference.exact()) return {Grade::exact, "exact"};
  const std::string losses = fmt::format("missed {}, false {}, duplicates {}", difference.missed,
                                         difference.false_pairs, difference.duplicates);
  if (how.exhibit()) return {Grade::exhibit, losses + " (an exhibit: not counted)"};
  return {Grade::wrong, losses};
}

Verdict try_implementation(const Implementation& how, const Scene& scene,
                           const std::vector<Pair>& truth, const Limits& limits) {
  if (const auto reason = how.backend->why_unavailable()) return {Grade::skipped, *reason};
  PlanOptions options = how.plan_options(limits.threads);
  options.candidate_limit = limits.candidates;
  try {
    const std::unique_ptr<PairFinder> finder = how.backend->create();
    const Outcome outcome = find_completely(*finder, scene.view(), options);
    if (outcome.counts.over_candidate_limit) {
      return {Grade::skipped, fmt::format("{} candidates, over the limit of {}",
                                          outcome.counts.candidates, options.candidate_limit)};
    }
    return judge(how, reference::compare(finder->download(), truth));
  } catch (const LimitError& limit) {
    return {Grade::skipped, limit.what()};
  }
}

void print_verdict(const Implementation& how, const Verdict& verdict) {
  static const bool colours = isatty(STDOUT_FILENO) != 0;
  static constexpr fmt::terminal_color kColours[] = {
      fmt::terminal_color::green, fmt::terminal_color::red, fmt::terminal_color::yellow,
      fmt::terminal_color::bright_black};
  const std::string text =
      verdict.grade == Grade::skipped ? "skipped: " + verdict.text : verdict.text;
  fmt::print("  {:<40} ", how.label());
  if (!colours) return fmt::print("{}\n", text);
  fmt::print(fmt::fg(kColours[static_cast<std::size_t>(verdict.grade)]), "{}\n", text);
}

std::vector<std::string> scenes_or_default(const Options& options) {
  if (!options.scenes.empty()) return options.scenes;
  std::vector<std::string> all;
  for (const SceneInfo& scene : scenes())
    all.push_back(std::string(scene.name).append(kDefaultSize));
  return all;
}

int check(const Options& options) {
  const std::vector<Implementation> rows = implementations(options.backend);
  if (!(options.candidate_limit >= 0.0) || options.candidate_limit > 1e19) {
    throw InputError(
        fmt::format("--candidate-limit {}: must be 0 to 1e19", options.candidate_limit));
  }
  const Limits limits = {.threads = thread_count(options.threads),
                         .candidates = static_cast<std::uint64_t>(options.candidate_limit)};
  int totals[4] = {};
  for (const std::string& argument : scenes_or_default(options)) {
    const Scene scene = load_or_generate(argument);
    const std::vector<Pair> truth = reference::exact_pairs(scene.spheres);
    fmt::print("{} ({} spheres, {} pairs)\n", scene.spec, scene.spheres.size(), truth.size());
    for (const Implementation& how : rows) {
      const Verdict verdict = try_implementation(how, scene, truth, limits);
      print_verdict(how, verdict);
      ++totals[static_cast<std::size_t>(verdict.grade)];
    }
    std::fflush(stdout);
  }
  fmt::print("{} exact, {} wrong, {} exhibits with losses, {} skipped\n", totals[0], totals[1],
             totals[2], totals[3]);
  return totals[1] == 0 ? 0 : kExitWrongAnswer;
}

}  // namespace

void add_check(CLI::App& app, Command& command) {
  auto o = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("check", "Compare every implementation with the exact pair set");
  sub->add_option("SCENE", o->scenes, "Files or generators; none: every generator, small");
  sub->add_option("--backend", o->backend, "A backend, a baseline, or all");
  sub->add_option("--threads", o->threads, "Threads; 0 (default): all");
  sub->add_option("--candidate-limit", o->candidate_limit,
                  "Skip a row that counts more candidate pairs than this");
  sub->callback([&command, o] { command = [o] { return check(*o); }; });
}

}  // namespace octocell::cli
