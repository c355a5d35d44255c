// SPDX-License-Identifier: MIT
// How a scene would be searched, the devices, and the release.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/planner/explain.hpp"
#include "include/octocell/octocell.hpp"
#include "library/errors.hpp"
#include "library/search.hpp"

namespace octocell {

using library::with_errors;

struct ScenePlan::Inside {
  PlanOptions how;
  SceneStats stats;
  Plan plan;
};

ScenePlan::ScenePlan(std::unique_ptr<Inside> inside) noexcept : inside_(std::move(inside)) {}
ScenePlan::ScenePlan(ScenePlan&& other) noexcept = default;
ScenePlan& ScenePlan::operator=(ScenePlan&& other) noexcept = default;
ScenePlan::~ScenePlan() = default;

std::string ScenePlan::explain() const {
  return with_errors(
      [&] { return to_text(octocell::explain(inside_->stats, inside_->plan, inside_->how)); });
}

ScenePlan plan(std::span<const Sphere> spheres, const Options& options) {
  return with_errors([&] {
    const PlanOptions how = library::plan_options_of(options);
    SceneView scene = {spheres, options.flags};
    std::optional<images::ImageFinder> finder;
    if (options.box || options.cutoff != 0.0 || !options.batch.empty()) {
      finder.emplace(how.threads);
      // If each two are compared, the scene itself is described.
      images::Question question = library::question_of(scene, options.box, options.cutoff);
      question.batch = options.batch;
      scene = finder->searched_scene(question).value_or(scene);
    }
    SceneStats stats = measure(scene);
    Plan made = make_plan(stats, how);
    return ScenePlan(std::make_unique<ScenePlan::Inside>(how, std::move(stats), std::move(made)));
  });
}

std::string_view version() noexcept { return OCTOCELL_VERSION; }

std::optional<std::string> why_unavailable(Device device) {
  return with_errors([&] { return library::backend_of(device).why_unavailable(); });
}

}  // namespace octocell
