// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/cli/own_choices.hpp"
#include "harness/cli/scene_options.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/files/json_text.hpp"
#include "harness/files/named_files.hpp"
#include "harness/files/output_file.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/trace/run_trace.hpp"
#include "harness/trace/step_page.hpp"

namespace octocell::cli {
namespace {

/// A trace holds every entry and every candidate, so scenes must be small.
constexpr std::size_t kMostSpheres = 10'000;
constexpr std::uint64_t kMostCandidates = 1'000'000;
constexpr std::uint64_t kMostIds = 1'000'000;

struct Options {
  std::vector<std::string> scenes;
  std::string backend = "impl_cpu";
  OwnChoices own;
  LoadOptions load;
  std::optional<std::string> output;
  std::optional<std::string> page;
  bool text = false;
};

/// The rules of home_phantom unless another method is asked for: they are what a course teaches.
Implementation chosen_implementation(const Options& options) {
  Implementation how{.backend = &backend_named(options.backend)};
  if (how.is_baseline()) {
    throw InputError(fmt::format("{} is a library: its arrays cannot be seen", how.backend->name));
  }
  require_available(*how.backend);
  choose_method(how, options.own);
  if (options.own.method.empty()) how.method = Method::home_phantom;
  return how;
}

void check_files(const Options& options) {
  if (options.scenes.size() > 1 && !options.page) {
    throw InputError("several scenes fit only into a page: --html FILE");
  }
  if (options.page && options.page->empty()) {
    throw InputError("cannot write --html: the file name is empty");
  }
  if (options.output && options.output->empty()) {
    throw InputError("cannot write --output: the file name is empty");
  }
  NamedFiles files;
  for (const std::string& scene : options.scenes) files.read_scene(scene, options.load.flags);
  files.write("--output", options.output);
  files.write("--html", options.page);
  files.require_separate();
}

void require_few_spheres(const Scene& scene) {
  if (scene.spheres.size() <= kMostSpheres) return;
  throw LimitError(fmt::format("{}: {} spheres; a trace shows at most {}", scene.spec,
                               scene.spheres.size(), kMostSpheres));
}

void require_small(const Scene& scene, const Outcome& outcome) {
  const Counts& counts = outcome.counts;
  if (!counts.over_candidate_limit && counts.ids <= kMostIds) return;
  throw LimitError(
      fmt::format("{}: {} ids and {} candidates or more: a trace shows at most {} of each",
                  scene.spec, counts.ids, counts.candidates, kMostCandidates));
}

/// Cells as wide as the largest sphere, as in the course: the planner may put a small scene into
/// one.
void choose_cell_side(PlanOptions& asked, const Scene& scene) {
  if (asked.method != Method::home_phantom || asked.rule != Rule::lowest_cell) return;
  double r_max = 0.0;
  for (const Sphere& s : scene.spheres) r_max = std::max(r_max, static_cast<double>(s.r));
  if (!asked.cell_side && r_max > 0.0) asked.cell_side = 2.0 * r_max;
}

trace::RunTrace run_and_record(const Options& options, const Scene& scene) {
  const Implementation how = chosen_implementation(options);
  PlanOptions asked = plan_options_of(how, options.own, 1);
  asked.candidate_limit = kMostCandidates;
  choose_cell_side(asked, scene);
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  trace::RunTrace run = {.scene = scene.spec,
                         .backend = how.backend->name,
                         .view = scene.view(),
                         .plan = {},
                         .cell_side = asked.cell_side,
                         .record = {},
                         .pairs = {}};
  finder->record(&run.record);
  const Outcome outcome = find_completely(*finder, scene.view(), asked);
  require_small(scene, outcome);
  run.plan = outcome.plan;
  run.pairs = finder->download();
  return run;
}

int trace_scenes(const Options& options) {
  check_files(options);
  std::vector<Scene> scenes;
  for (const std::string& scene : options.scenes) {
    scenes.push_back(load_and_say(scene, options.load));
    require_few_spheres(scenes.back());
    if (options.page) trace::require_drawable(scenes.back().view(), scenes.back().spec);
  }
  std::vector<trace::RunTrace> runs;
  runs.reserve(scenes.size());
  for (const Scene& scene : scenes) runs.push_back(run_and_record(options, scene));

  if (options.page) write_whole_file(*options.page, trace::step_page(runs));
  if (options.output) {
    write_whole_file(*options.output, json_text(trace::to_json(runs.front()), -1) + "\n");
  }
  if (options.text || (!options.page && !options.output)) {
    fmt::print("{}", trace::to_text(runs.front()));
  }
  return 0;
}

}  // namespace

void add_trace(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Show every array of a run: what each stage read and wrote, for small scenes");
  sub.add_option("SCENE", o->scenes, std::string(kSceneHelp) + "; several with --html")->required();
  add_scene_options(sub, o->load);
  sub.add_option("--backend", o->backend, "A backend; see 'octocell list'");
  add_own_choices(sub, o->own);
  sub.get_option("--method")
      ->description(
          "home_phantom (default), half_shell, brute_force, tiles, or planned: what find would "
          "take");
  sub.get_option("--cell-side")
      ->description(
          "Cell side in scene units, for rule lowest_cell; default: the largest diameter");
  sub.add_option("-o,--output", o->output, "Write JSON (docs/trace.schema.json)");
  sub.add_option("--html", o->page, "Write a page to step through; up to 32 spheres a scene");
  sub.add_flag("--text", o->text, "Print tables (the default without -o and --html)");
  sub.callback([&command, o] { command = [o] { return trace_scenes(*o); }; });
}

}  // namespace octocell::cli
