// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/available_memory.hpp"
#include "core/depth.hpp"
#include "core/flags.hpp"
#include "core/planner/explain.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/find_images.hpp"
#include "harness/cli/names.hpp"
#include "harness/cli/own_choices.hpp"
#include "harness/cli/scene_options.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/files/json_text.hpp"
#include "harness/files/named_files.hpp"
#include "harness/files/save.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::string scene;
  std::string backend;  // empty: the first plug-in, or impl_cpu
  std::vector<std::string> plugins;
  std::string predicate;
  OwnChoices own;
  LoadOptions load;
  ImageOptions images;
  std::optional<std::string> output;
  std::optional<std::string> depth;
  int threads = 0;
  bool depth_check = false;
  bool count = false;
  bool json = false;
  bool explain = false;
};

Implementation chosen_implementation(const Options& options) {
  const std::string_view unnamed = load_plugins(options.plugins).value_or("impl_cpu");
  Implementation chosen{.backend =
                            &backend_named(options.backend.empty() ? unnamed : options.backend)};
  const bool asks_for_method = options.own.any() || !options.predicate.empty() || options.explain;
  if (chosen.is_baseline() && asks_for_method) {
    throw InputError(
        fmt::format("{} is a baseline: it has its own method, rule, predicate, cells and plan",
                    chosen.backend->name));
  }
  require_available(*chosen.backend);
  if (!options.predicate.empty()) {
    chosen.predicate = predicate_named(options.predicate, *chosen.backend);
  }
  choose_method(chosen, options.own);
  return chosen;
}

std::optional<reference::RoundingEffect> rounding_effect(const Scene& scene) {
  if (!scene.unrounded) return std::nullopt;
  return reference::rounding_effect(*scene.unrounded, scene.flags, reference::exact_pairs(scene));
}

std::ptrdiff_t count_static(const Scene& scene) {
  return std::ranges::count_if(scene.flags, is_static);
}

struct FindReport {
  const Scene& scene;
  Implementation implementation;
  Outcome outcome;
  PairDigest digest;
  std::optional<reference::RoundingEffect> rounding;
  std::optional<reference::DepthErrors> depth_errors;
};

int threads_of(const FindReport& report) {
  if (!report.implementation.backend->threaded) return 1;
  return report.outcome.counts.threads;
}

nlohmann::ordered_json to_json(const FindReport& report) {
  const Implementation& how = report.implementation;
  nlohmann::ordered_json json = {
      {"scene", report.scene.spec},
      {"n", report.scene.spheres.size()},
      {"static", count_static(report.scene)},
      {"backend", how.backend->name},
      {"method",
       how.is_baseline() ? nlohmann::ordered_json() : name_of(report.outcome.plan.method)},
      {"planned", how.planned()},
      {"rule",
       how.has_rule() ? nlohmann::ordered_json(name_of(how.rule)) : nlohmann::ordered_json()},
      {"predicate", how.is_baseline() ? nlohmann::ordered_json()
                                      : nlohmann::ordered_json(name_of(how.predicate))},
      {"threads", threads_of(report)},
      {"pairs", report.digest.count},
      {"checksum", fmt::format("{:#018x}", report.digest.checksum)},
      {"candidates", report.outcome.counts.candidates},
      {"uncertain_pairs", report.outcome.counts.uncertain_pairs},
      {"runs", report.outcome.runs},
      {"plan_ms", report.outcome.plan_ms},
      {"total_ms", report.outcome.times.total_ms}};
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (std::size_t s = 0; s < kStageCount; ++s) {
    const auto& ms = report.outcome.times.stage_ms[s];
    if (ms) stages[std::string(kStageNames[s])] = *ms;
  }
  json["stage_ms"] = stages;
  if (report.rounding) {
    json["rounding"] = {{"lost", report.rounding->lost}, {"gained", report.rounding->gained}};
  }
  if (const auto& errors = report.depth_errors) {
    json["depth_error_ulp"] = {{"median", errors->median_ulp},
                               {"p99", errors->p99_ulp},
                               {"max", errors->max_ulp},
                               {"not_nearest", errors->not_nearest}};
  }
  return json;
}

void print_text(const FindReport& report) {
  const Implementation& how = report.implementation;
  const int threads = threads_of(report);
  fmt::print("scene       {} ({} spheres{})\n", report.scene.spec, report.scene.spheres.size(),
             report.scene.flags.empty()
                 ? ""
                 : fmt::format(" with flags, {} static", count_static(report.scene)));
  fmt::print("backend     {}, {} thread{}\n", how.label(), threads, threads == 1 ? "" : "s");
  if (how.negative_control()) {
    fmt::print("            a negative control: this {} can be wrong\n",
               claims_exact(how.predicate) ? "rule" : "predicate");
  }
  if (how.has_known_issues()) {
    fmt::print("            may lose pairs: {}\n", how.backend->known_issues);
  }
  if (report.rounding) {
    fmt::print("rounding    to float32 lost {} pairs and gained {}\n", report.rounding->lost,
               report.rounding->gained);
  }
  fmt::print("pairs       {}\n", report.digest.count);
  fmt::print("checksum    {:#018x}\n", report.digest.checksum);
  fmt::print("candidates  {}\n", report.outcome.counts.candidates);
  if (const auto& errors = report.depth_errors) {
    fmt::print(
        "depth error {:.4g} ULP median, {:.4g} p99, {:.7g} max; {} not the nearest float32\n",
        errors->median_ulp, errors->p99_ulp, errors->max_ulp, errors->not_nearest);
  }
  if (!how.is_baseline()) fmt::print("planning    {:.3f} ms\n", report.outcome.plan_ms);
  for (std::size_t s = 0; s < kStageCount; ++s) {
    const auto& ms = report.outcome.times.stage_ms[s];
    if (ms) fmt::print("{:<11} {:.3f} ms\n", kStageNames[s], *ms);
  }
  fmt::print("total       {:.3f} ms\n", report.outcome.times.total_ms);
}

void check_outputs(const Options& options) {
  if (options.output && options.output->empty())
    throw InputError("cannot write --output: the file name is empty");
  if (options.images.shifts && options.images.shifts->empty())
    throw InputError("cannot write --shifts: the file name is empty");
  if (options.depth && options.depth->empty())
    throw InputError("cannot write --depth: the file name is empty");
  if (options.count && options.output) {
    throw InputError("--count keeps no pairs, so there is nothing to write to --output");
  }
  if (options.count && (options.depth || options.depth_check)) {
    throw InputError("--count keeps no pairs, so there are no depths to write or to check");
  }
  if (options.images.any()) {
    question_of({}, options.images);  // or refuses
    if (options.depth || options.depth_check || options.explain || options.load.round_input) {
      throw InputError(
          "--box and --cutoff: not with --depth, --depth-check, --explain or --round-input");
    }
    if (options.count && options.images.shifts) {
      throw InputError("--count keeps no pairs, so there is nothing to write to --shifts");
    }
  }
  NamedFiles files;
  files.read_scene(options.scene, options.load.flags);
  files.write("--output", options.output);
  files.write("--depth", options.depth);
  files.write("--shifts", options.images.shifts);
  files.require_separate();
  if (options.output) require_savable_list(*options.output);
  if (options.depth) require_savable_list(*options.depth);
  if (options.images.shifts) require_savable_list(*options.images.shifts);
}

/// Writes what the options request. Depths are computed from the pairs.
std::optional<reference::DepthErrors> use_pairs(const Options& options, const Scene& scene,
                                                PairFinder& finder, const Outcome& outcome) {
  if (!options.output && !options.depth && !options.depth_check) return std::nullopt;
  const std::span<const Pair> pairs = fetch_pairs(finder, outcome);
  if (options.depth) {
    save_depths(*options.depth, scene.spheres, pairs, options.output.value_or(""));
  } else if (options.output) {
    save_pairs(*options.output, pairs);
  }
  if (!options.depth_check) return std::nullopt;
  constexpr double kBytesPerDepth = sizeof(float) + sizeof(double);  // a depth and its error
  require_memory(kBytesPerDepth * static_cast<double>(pairs.size()), "--depth-check");
  return reference::depth_errors(penetration_depths(scene.spheres, pairs), pairs, scene.spheres);
}

int find(const Options& options) {
  if (options.load.round_input || options.depth_check) reference::require_available();
  check_outputs(options);
  const Implementation how = chosen_implementation(options);
  PlanOptions plan_options = plan_options_of(how, options.own, options.threads);
  plan_options.count_only = options.count;
  const Scene scene = load_and_say(options.scene, options.load);
  if (options.images.any()) {
    return find_images(scene, options.images, how, plan_options,
                       {.pairs = options.output, .count = options.count, .json = options.json});
  }
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  const Outcome outcome = find_completely(*finder, scene.view(), plan_options);
  say_if_threads_lack(outcome.plan, outcome.counts);
  require_used(plan_options.forced, outcome.counts.used);
  const auto depth_errors = use_pairs(options, scene, *finder, outcome);

  const FindReport report = {.scene = scene,
                             .implementation = how,
                             .outcome = outcome,
                             .digest = finder->digest(),
                             .rounding = rounding_effect(scene),
                             .depth_errors = depth_errors};
  if (options.explain) {
    fmt::print(stderr, "{}",
               to_text(explain(*outcome.stats, outcome.plan, plan_options, outcome.counts.used)));
  }
  if (options.json) {
    fmt::print("{}\n", json_text(to_json(report), 2));
  } else {
    print_text(report);
  }
  return 0;
}

}  // namespace

void add_find(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Find every overlapping pair of a scene");
  sub.add_option("SCENE", o->scene, kSceneHelp)->required();
  add_scene_options(sub, o->load);
  add_image_options(sub, o->images);
  sub.add_option("--backend", o->backend,
                 "A backend or a baseline (default impl_cpu, or the plug-in); see 'octocell list'");
  add_plugin_option(sub, o->plugins);
  add_own_choices(sub, o->own);
  sub.add_option("--predicate", o->predicate, kPredicateHelp);
  sub.add_option("--threads", o->threads, "Threads; 0 (default): all");
  sub.add_option("-o,--output", o->output, "Write the pairs: NPY, (M, 2) uint32, i < j, sorted");
  sub.add_option("--depth", o->depth,
                 "Write how deep each pair overlaps: NPY, (M,) float32, in the pairs' order");
  sub.add_flag("--depth-check", o->depth_check,
               "Compare the depths with exact ones; print their errors in ULP of float32");
  sub.add_flag("--count", o->count, "Print only count and checksum; needs no memory for pairs");
  sub.add_flag("--json", o->json, "Print JSON");
  sub.add_flag("--explain", o->explain, "Print the plan's decisions on stderr");
  sub.callback([&command, o] { command = [o] { return find(*o); }; });
}

}  // namespace octocell::cli
