// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/driver/complete.hpp"
#include "harness/interface/flags.hpp"
#include "harness/planner/explain.hpp"
#include "harness/reference/reference.hpp"
#include "harness/registry/registry.hpp"
#include "harness/scenes/save.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::string scene;
  std::string backend = "impl_cpu";
  std::string method;
  std::string rule;
  std::string predicate;
  std::optional<std::string> flags;
  std::optional<std::string> output;
  std::optional<double> cell_side;
  int threads = 0;
  bool count = false;
  bool json = false;
  bool explain = false;
  bool round_input = false;
  std::vector<std::string> no_skip;
  std::vector<std::string> force;
};

Implementation chosen_implementation(const Options& options) {
  Implementation chosen{.backend = &backend_named(options.backend)};
  const bool asks_for_method = !options.method.empty() || !options.rule.empty() ||
                               !options.predicate.empty() || options.cell_side || options.explain ||
                               !options.no_skip.empty() || !options.force.empty();
  if (chosen.is_baseline() && asks_for_method) {
    throw InputError(
        fmt::format("{} is a baseline: it has its own method, rule, predicate, cells and plan",
                    chosen.backend->name));
  }
  if (const auto reason = chosen.backend->why_unavailable()) {
    throw LimitError(fmt::format("{} cannot run here: {}", chosen.backend->name, *reason));
  }
  chosen.method = method_or_planned(options.method);
  if (!options.rule.empty()) chosen.rule = rule_named(options.rule);
  if (!options.predicate.empty()) {
    chosen.predicate = predicate_named(options.predicate, *chosen.backend);
  }
  const bool of_home_phantom = !options.rule.empty() || options.cell_side;
  if (chosen.planned() && of_home_phantom) chosen.method = Method::home_phantom;
  if (!chosen.has_rule() && of_home_phantom) {
    throw InputError(fmt::format("method {} has no rules and no cells", chosen.method_name()));
  }
  return chosen;
}

/// What rounding a float64 file to float32 did to the exact pair set.
struct RoundingEffect {
  std::uint64_t lost = 0;
  std::uint64_t gained = 0;
};

std::optional<RoundingEffect> rounding_effect(const Scene& scene) {
  if (!scene.unrounded) return std::nullopt;
  const std::vector<Pair> before = reference::box_tree(std::span(*scene.unrounded), scene.flags);
  const std::vector<Pair> after = reference::exact_pairs(scene);
  const reference::Comparison change = reference::compare(after, before);
  return RoundingEffect{.lost = change.missed, .gained = change.false_pairs};
}

std::ptrdiff_t count_static(const Scene& scene) {
  return std::ranges::count_if(scene.flags, is_static);
}

struct Answer {
  const Scene& scene;
  Implementation implementation;
  Outcome outcome;
  PairDigest digest;
  std::optional<RoundingEffect> rounding;
};

nlohmann::ordered_json to_json(const Answer& answer) {
  const Implementation& how = answer.implementation;
  nlohmann::ordered_json json = {
      {"scene", answer.scene.spec},
      {"n", answer.scene.spheres.size()},
      {"static", count_static(answer.scene)},
      {"backend", how.backend->name},
      {"method",
       how.is_baseline() ? nlohmann::ordered_json() : name_of(answer.outcome.plan.method)},
      {"planned", how.planned()},
      {"rule",
       how.has_rule() ? nlohmann::ordered_json(name_of(how.rule)) : nlohmann::ordered_json()},
      {"predicate", how.is_baseline() ? nlohmann::ordered_json()
                                      : nlohmann::ordered_json(name_of(how.predicate))},
      {"threads", how.backend->threaded ? answer.outcome.plan.threads : 1},
      {"pairs", answer.digest.count},
      {"checksum", fmt::format("{:#018x}", answer.digest.checksum)},
      {"candidates", answer.outcome.counts.candidates},
      {"doubts", answer.outcome.counts.doubts},
      {"runs", answer.outcome.runs},
      {"plan_ms", answer.outcome.plan_ms},
      {"total_ms", answer.outcome.times.total_ms}};
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (std::size_t s = 0; s < kStageCount; ++s) {
    const auto& ms = answer.outcome.times.stage_ms[s];
    if (ms) stages[std::string(kStageNames[s])] = *ms;
  }
  json["stage_ms"] = stages;
  if (answer.rounding) {
    json["rounding"] = {{"lost", answer.rounding->lost}, {"gained", answer.rounding->gained}};
  }
  return json;
}

void print_text(const Answer& answer) {
  const Implementation& how = answer.implementation;
  const int threads = how.backend->threaded ? answer.outcome.plan.threads : 1;
  fmt::print("scene       {} ({} spheres{})\n", answer.scene.spec, answer.scene.spheres.size(),
             answer.scene.flags.empty()
                 ? ""
                 : fmt::format(" with flags, {} static", count_static(answer.scene)));
  fmt::print("backend     {}, {} thread{}\n", how.label(), threads, threads == 1 ? "" : "s");
  if (how.exhibit()) {
    fmt::print("            an exhibit: this {} can be wrong\n",
               claims_exact(how.predicate) ? "rule" : "predicate");
  }
  if (how.has_known_faults()) {
    fmt::print("            may lose pairs: {}\n", how.backend->known_faults);
  }
  if (answer.rounding) {
    fmt::print("rounding    to float32 lost {} pairs and gained {}\n", answer.rounding->lost,
               answer.rounding->gained);
  }
  fmt::print("pairs       {}\n", answer.digest.count);
  fmt::print("checksum    {:#018x}\n", answer.digest.checksum);
  fmt::print("candidates  {}\n", answer.outcome.counts.candidates);
  if (!how.is_baseline()) fmt::print("planning    {:.3f} ms\n", answer.outcome.plan_ms);
  for (std::size_t s = 0; s < kStageCount; ++s) {
    const auto& ms = answer.outcome.times.stage_ms[s];
    if (ms) fmt::print("{:<11} {:.3f} ms\n", kStageNames[s], *ms);
  }
  fmt::print("total       {:.3f} ms\n", answer.outcome.times.total_ms);
}

int find(const Options& options) {
  if (options.output && options.output->empty())
    throw InputError("cannot write --output: no file is named");
  if (options.count && options.output) {
    throw InputError("--count keeps no pairs, so there is nothing to write to --output");
  }
  const Implementation how = chosen_implementation(options);
  PlanOptions plan_options =
      with_skips(how.plan_options(thread_count(options.threads)), options.no_skip, options.force);
  plan_options.count_only = options.count;
  plan_options.cell_side = options.cell_side;
  const Scene scene =
      load_or_generate(options.scene, {.flags = options.flags, .round_input = options.round_input});
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  const Outcome outcome = find_completely(*finder, scene.view(), plan_options);
  require_used(plan_options.forced, outcome.counts.used);
  if (options.output) save_pairs(*options.output, finder->download());

  const Answer answer = {.scene = scene,
                         .implementation = how,
                         .outcome = outcome,
                         .digest = finder->digest(),
                         .rounding = rounding_effect(scene)};
  if (options.explain) {
    fmt::print(
        stderr, "{}",
        to_text(explain(measure(scene.view()), outcome.plan, plan_options, outcome.counts.used)));
  }
  if (options.json) {
    fmt::print("{}\n", to_json(answer).dump(2));
  } else {
    print_text(answer);
  }
  return 0;
}

}  // namespace

void add_find(CLI::App& app, Command& command) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("find", "Find every overlapping pair of a scene");
  sub->add_option("SCENE", o->scene, "A file (.npy, .csv, .pqr) or a generator: gas:n=1e5,seed=7")
      ->required();
  sub->add_option("--flags", o->flags, kFlagsHelp);
  sub->add_option("--backend", o->backend, "A backend or a baseline; see 'octocell list'");
  sub->add_option(
      "--method", o->method,
      "planned (default: the planner chooses), home_phantom, half_shell or brute_force");
  sub->add_option("--rule", o->rule,
                  "Of home_phantom: lowest_cell (default), chapter32 or as_written");
  sub->add_option("--predicate", o->predicate, kPredicateHelp);
  sub->add_option("--cell-side", o->cell_side, "Cell side in scene units, for rule lowest_cell");
  sub->add_option("--threads", o->threads, "Threads; 0 (default): all");
  sub->add_option("-o,--output", o->output, "Write the pairs: NPY, (M, 2) uint32, i < j, sorted");
  add_skip_options(*sub, o->no_skip, o->force);
  sub->add_flag("--count", o->count, "Count and checksum only: needs no memory for pairs");
  sub->add_flag("--json", o->json, "Print JSON");
  sub->add_flag("--explain", o->explain, "Print the plan's decisions on stderr");
  sub->add_flag("--round-input", o->round_input,
                "Accept a float64 NPY, round it to float32, and say which pairs that changed");
  sub->callback([&command, o] { command = [o] { return find(*o); }; });
}

}  // namespace octocell::cli
