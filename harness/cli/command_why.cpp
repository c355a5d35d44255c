// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "core/planner/planner.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/cli/own_choices.hpp"
#include "harness/cli/scene_options.hpp"
#include "harness/engine/registry.hpp"
#include "harness/files/json_text.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/trace/why.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::string scene;
  std::uint64_t i = 0;
  std::uint64_t j = 0;
  OwnChoices own;
  LoadOptions load;
  bool json = false;
};

void require_pair(const Options& options, std::size_t spheres) {
  for (const std::uint64_t id : {options.i, options.j}) {
    if (id < spheres) continue;
    throw InputError(
        fmt::format("no sphere {}: the scene has {} spheres, numbered from 0", id, spheres));
  }
  if (options.i == options.j)
    throw InputError(fmt::format("{} twice: a pair is two spheres", options.i));
}

/// The rules of home_phantom unless another method is asked for: they are what a course teaches.
/// Nothing runs, so a method that only a GPU has needs none here.
Implementation chosen_implementation(const Options& options) {
  const bool tiles = options.own.method == name_of(Method::tiles);
  Implementation how{.backend = &backend_named(tiles ? "impl_cuda_custom" : "impl_cpu")};
  choose_method(how, options.own);
  if (options.own.method.empty()) how.method = Method::home_phantom;
  return how;
}

int why_pair(const Options& options) {
  const PlanOptions asked = plan_options_of(chosen_implementation(options), options.own, 1);
  const Scene scene = load_and_say(options.scene, options.load);
  require_pair(options, scene.spheres.size());
  const Plan plan = make_plan(measure(scene.view()), asked);
  const trace::Account account =
      trace::why(plan, scene.view(), static_cast<std::uint32_t>(options.i),
                 static_cast<std::uint32_t>(options.j));
  if (options.json) {
    fmt::print("{}\n", json_text(trace::to_json(account, scene.spec), 2));
  } else {
    fmt::print("{}", trace::to_text(account, scene.spec));
  }
  return 0;
}

}  // namespace

void add_why(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Say why a pair is found, or is not");
  sub.add_option("SCENE", o->scene, kSceneHelp)->required();
  sub.add_option("I", o->i, "The number of a sphere, from 0")->required();
  sub.add_option("J", o->j, "The number of another")->required();
  add_scene_options(sub, o->load);
  add_own_choices(sub, o->own);
  sub.add_flag("--json", o->json, "Print JSON");
  sub.callback([&command, o] { command = [o] { return why_pair(*o); }; });
}

}  // namespace octocell::cli
