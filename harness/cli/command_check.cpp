// SPDX-License-Identifier: MIT
#include <fmt/color.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/cli/scene_options.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/isolate.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::string backend = "all";
  std::vector<std::string> plugins;
  LoadOptions load;
  int threads = 0;
  double candidate_limit = 2e10;
  double timeout = 60.0;  // seconds
  bool strict = false;
};

constexpr std::string_view kDefaultSize = ":n=2000";

enum class Grade : std::uint8_t { exact, wrong, known_issue, negative_control, skipped };

struct SceneVerdict {
  Grade grade;
  std::string text;
  std::string first_wrong = {};  // lines, if pairs are wrong
};

struct Limits {
  int threads;
  std::uint64_t candidates;
  std::chrono::duration<double> time;  // for a baseline
};

struct HeldPairs {
  Counts counts;
  std::span<const Pair> pairs;  // stored in `finder` or in `received`
  std::unique_ptr<PairFinder> finder = {};
  std::vector<Pair> received = {};
};

/// Returns for example "12 (3.1 per million, deepest 0.02 of r1 + r2)", or "0".
std::string wrong_pairs(std::uint64_t count, std::size_t true_pairs, std::string_view worst_name,
                        const std::optional<double>& worst) {
  if (count == 0) return "0";
  const double rate = 1e6 * static_cast<double>(count) / static_cast<double>(true_pairs);
  return fmt::format("{} ({}{} {:.2g} of r1 + r2)", count,
                     true_pairs == 0 ? "" : fmt::format("{:.3g} per million, ", rate), worst_name,
                     *worst);
}

std::string text_of(const reference::Comparison& difference, std::size_t true_pairs) {
  return fmt::format(
      "missed {}, false {}, duplicates {}",
      wrong_pairs(difference.missed, true_pairs, "deepest", difference.worst_missed_depth),
      wrong_pairs(difference.false_pairs, true_pairs, "farthest apart", difference.worst_false_gap),
      difference.duplicates);
}

/// The options of `why` for the cells that an implementation uses; none for a baseline's own.
std::string why_options(const Implementation& how) {
  return how.has_rule() ? fmt::format("--rule {}", name_of(how.rule))
                        : fmt::format("--method {}", how.method_name());
}

/// The first wrong pair of each kind, and the command that says why.
std::string first_wrong_of(const Implementation& how, const reference::Comparison& difference,
                           const std::string& scene) {
  std::string text;
  const auto add = [&](std::string_view kind, const std::optional<Pair>& pair) {
    if (!pair) return;
    text += fmt::format("      first {}: {} {}", kind, pair->i, pair->j);
    if (!how.is_baseline())
      text += fmt::format("; octocell why {} {} {} {}", scene, pair->i, pair->j, why_options(how));
    text += "\n";
  };
  add("missed", difference.first_missed);
  add("false", difference.first_false);
  add("duplicate", difference.first_duplicate);
  return text;
}

SceneVerdict judge(const Implementation& how, const reference::Comparison& difference,
                   std::size_t true_pairs) {
  if (difference.exact()) return {Grade::exact, "exact"};
  const std::string losses = text_of(difference, true_pairs);
  if (how.negative_control())
    return {Grade::negative_control, losses + " (a negative control: not counted)"};
  // A library may lose pairs; but false pairs would be our fault, because we test its candidates.
  if (how.has_known_issues() && difference.only_missed()) {
    return {Grade::known_issue, fmt::format("wrong: {} (a known issue of the library: {})", losses,
                                            how.backend->known_issues)};
  }
  return {Grade::wrong, losses};
}

/// Runs baselines in a process of their own: some crash or never end on scenes that they were not
/// made for.
HeldPairs find(const Implementation& how, const Scene& scene, const PlanOptions& options,
               const Limits& limits) {
  if (how.is_baseline()) {
    FinderAnswer answer = find_isolated(how.backend->create, scene.view(), options, limits.time);
    const std::span<const Pair> pairs = answer.pairs;  // moving the answer does not move the pairs
    return {std::move(answer.counts), pairs, nullptr, std::move(answer.pairs)};
  }
  std::unique_ptr<PairFinder> finder = how.backend->create();
  const Outcome outcome = find_completely(*finder, scene.view(), options);
  say_if_threads_lack(outcome.plan, outcome.counts);
  if (outcome.counts.over_candidate_limit) return {outcome.counts, {}};
  const std::span<const Pair> pairs = fetch_pairs(*finder, outcome);
  return {outcome.counts, pairs, std::move(finder)};
}

SceneVerdict try_implementation(const Implementation& how, const Scene& scene,
                                const std::vector<Pair>& truth, const Limits& limits) {
  if (const auto reason = how.backend->why_unavailable()) return {Grade::skipped, *reason};
  PlanOptions options = how.plan_options(limits.threads);
  options.candidate_limit = limits.candidates;
  try {
    const HeldPairs found = find(how, scene, options, limits);
    if (found.counts.over_candidate_limit) {
      return {Grade::skipped, fmt::format("{} candidates, over the limit of {}",
                                          found.counts.candidates, options.candidate_limit)};
    }
    const reference::Comparison difference = reference::compare(found.pairs, truth, scene.spheres);
    SceneVerdict verdict = judge(how, difference, truth.size());
    verdict.first_wrong = first_wrong_of(how, difference, scene.spec);
    return verdict;
  } catch (const LimitError& limit) {
    return {Grade::skipped, limit.what()};
  }
}

void print_verdict(const Implementation& how, const SceneVerdict& verdict) {
  static const bool colours = isatty(STDOUT_FILENO) != 0;
  static constexpr fmt::terminal_color kColours[] = {
      fmt::terminal_color::green, fmt::terminal_color::red, fmt::terminal_color::magenta,
      fmt::terminal_color::yellow, fmt::terminal_color::bright_black};
  const std::string text =
      verdict.grade == Grade::skipped ? "skipped: " + verdict.text : verdict.text;
  fmt::print("  {:<42} ", how.label());
  if (colours) {
    fmt::print(fmt::fg(kColours[static_cast<std::size_t>(verdict.grade)]), "{}\n", text);
  } else {
    fmt::print("{}\n", text);
  }
  fmt::print("{}", verdict.first_wrong);
}

std::vector<std::string> scenes_or_default(const Options& options) {
  if (!options.scenes.empty()) return options.scenes;
  std::vector<std::string> all;
  for (const SceneInfo& scene : scenes())
    all.push_back(std::string(scene.name).append(kDefaultSize));
  return all;
}

Limits limits_of(const Options& options) {
  if (!(options.candidate_limit >= 0.0) || options.candidate_limit > 1e19) {
    throw InputError(
        fmt::format("--candidate-limit {}: must be 0 to 1e19", options.candidate_limit));
  }
  return {.threads = thread_count(options.threads),
          .candidates = static_cast<std::uint64_t>(options.candidate_limit),
          .time = time_limit(options.timeout)};
}

int check(const Options& options) {
  load_plugins(options.plugins);
  const std::vector<Implementation> rows = implementations(options.backend);
  const Limits limits = limits_of(options);
  if (options.load.flags && options.scenes.size() != 1) {
    throw InputError("--flags belongs to one scene: name exactly one");
  }
  int totals[5] = {};
  for (const std::string& argument : scenes_or_default(options)) {
    const Scene scene = load_and_say(argument, options.load);
    const std::vector<Pair> truth = reference::exact_pairs(scene);
    fmt::print("{} ({} spheres, {} pairs)\n", scene.spec, scene.spheres.size(), truth.size());
    for (const Implementation& how : rows) {
      const SceneVerdict verdict = try_implementation(how, scene, truth, limits);
      print_verdict(how, verdict);
      ++totals[static_cast<std::size_t>(verdict.grade)];
    }
    std::fflush(stdout);
  }
  const auto total = [&](Grade grade) { return totals[static_cast<std::size_t>(grade)]; };
  fmt::print("{} exact, {} wrong, {} known issues, {} negative controls with losses, {} skipped\n",
             total(Grade::exact), total(Grade::wrong), total(Grade::known_issue),
             total(Grade::negative_control), total(Grade::skipped));
  const int failures = total(Grade::wrong) + (options.strict ? total(Grade::known_issue) : 0);
  return failures == 0 ? 0 : kExitWrongAnswer;
}

}  // namespace

void add_check(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Compare every implementation with the exact pair set");
  sub.add_option("SCENE", o->scenes, "Files or generators (default: every generator, small)");
  add_scene_options(sub, o->load);
  sub.add_option("--backend", o->backend, "A backend, a baseline, or all");
  add_plugin_option(sub, o->plugins);
  sub.add_option("--threads", o->threads, "Threads; 0 (default): all");
  sub.add_option("--candidate-limit", o->candidate_limit,
                 "Skip a row that counts more candidate pairs than this");
  sub.add_option("--timeout", o->timeout, "Time limit of a baseline in seconds (default 60)");
  sub.add_flag("--strict", o->strict, "Exit with 1 also for known issues of libraries");
  sub.callback([&command, o] { command = [o] { return check(*o); }; });
}

}  // namespace octocell::cli
