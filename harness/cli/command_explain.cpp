// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/planner/explain.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/cli/own_choices.hpp"
#include "harness/cli/scene_options.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/median.hpp"
#include "harness/engine/registry.hpp"
#include "harness/files/json_text.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::cli {
namespace {

constexpr int kRounds = 15;

struct Options {
  std::string scene;
  std::string backend = "impl_cpu";
  LoadOptions load;
  OwnChoices own;
  int threads = 0;
  bool analyze = false;
  bool json = false;
};

/// A finder with one plan, ready to run.
class Candidate {
 public:
  Candidate(const BackendInfo& backend, SceneView scene, const PlanOptions& options)
      : finder_(backend.create()), outcome_(find_completely(*finder_, scene, options)) {
    clock_ = finder_->make_clock(Marks::off);
  }
  void run() {
    finder_->find_pairs(*clock_);
    times_.push_back(clock_->stop().total_ms);
  }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }

 private:
  std::unique_ptr<PairFinder> finder_;
  Outcome outcome_;
  std::unique_ptr<StageClock> clock_;
  std::vector<double> times_;
};

/// Returns the median over the rounds of the part of the time that a skip saves.
double saving(const std::vector<double>& with, const std::vector<double>& without) {
  std::vector<double> parts;
  for (std::size_t k = 0; k < with.size(); ++k) parts.push_back(1.0 - with[k] / without[k]);
  return median(std::move(parts));
}

/// Times the plan, and in turn a plan without each skip that it takes.
void analyze(Explanation& explanation, Candidate& planned, const BackendInfo& backend,
             SceneView scene, const PlanOptions& options) {
  std::vector<std::pair<Decision*, std::unique_ptr<Candidate>>> rivals;
  for (Decision& decision : explanation.decisions) {
    if (!decision.taken) continue;
    const PlanOptions without = without_skip(options, decision.skip);
    try {
      rivals.emplace_back(&decision, std::make_unique<Candidate>(backend, scene, without));
    } catch (const LimitError&) {  // there is no plan without it
    }
  }
  for (int round = 0; round < kRounds; ++round) {
    fmt::print(stderr, "\rround {} of {}{}", round + 1, kRounds, round + 1 == kRounds ? "\n" : "");
    planned.run();
    for (const auto& [decision, rival] : rivals) rival->run();
  }
  for (const auto& [decision, rival] : rivals) {
    decision->measured_saving = saving(planned.times(), rival->times());
  }
}

nlohmann::ordered_json to_json(const Explanation& explanation, const Outcome& outcome) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(); };
  Json decisions = Json::array();
  for (const Decision& d : explanation.decisions) {
    const SkipInfo& info = kSkips[static_cast<std::size_t>(d.skip)];
    decisions.push_back({{"skip", info.name},
                         {"taken", d.taken},
                         {"saves", info.saves},
                         {"fact", d.fact},
                         {"proof", info.proof},
                         {"expected_saving", or_null(d.expected_saving)},
                         {"measured_saving", or_null(d.measured_saving)}});
  }
  return {{"scene", explanation.scene},
          {"method", name_of(outcome.plan.method)},
          {"cells", explanation.method},
          {"sort", explanation.sort},
          {"predicate", explanation.predicate},
          {"pairs", outcome.counts.pairs},
          {"candidates", outcome.counts.candidates},
          {"decisions", decisions},
          {"warnings", explanation.warnings}};
}

PlanOptions plan_options(const Options& options) {
  Implementation how{.backend = &backend_named(options.backend)};
  if (how.is_baseline()) {
    throw InputError(fmt::format("{} is a baseline: it has its own plan", options.backend));
  }
  require_available(*how.backend);
  choose_method(how, options.own);
  return plan_options_of(how, options.own, options.threads);
}

int explain_scene(const Options& options) {
  const PlanOptions asked = plan_options(options);
  const Scene scene = load_and_say(options.scene, options.load);
  const SceneStats stats = measure(scene.view());
  const BackendInfo& backend = backend_named(options.backend);
  Candidate planned(backend, scene.view(), asked);
  const Outcome& outcome = planned.outcome();
  require_used(asked.forced, outcome.counts.used);
  Explanation explanation = explain(*outcome.stats, outcome.plan, asked, outcome.counts.used);
  if (options.analyze) analyze(explanation, planned, backend, scene.view(), asked);
  if (options.json) {
    fmt::print("{}\n", json_text(to_json(explanation, outcome), 2));
  } else {
    fmt::print("{}", to_text(explanation));
  }
  return 0;
}

}  // namespace

void add_explain(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Explain what a scene needs, what it does not need, and why");
  sub.add_option("SCENE", o->scene, kSceneHelp)->required();
  add_scene_options(sub, o->load);
  sub.add_option("--backend", o->backend, "A backend; see 'octocell list'");
  add_own_choices(sub, o->own);
  sub.add_option("--threads", o->threads, "Threads; 0 (default): all");
  sub.add_flag("--analyze", o->analyze, "Measure how much time each skip saves");
  sub.add_flag("--json", o->json, "Print JSON");
  sub.callback([&command, o] { command = [o] { return explain_scene(*o); }; });
}

}  // namespace octocell::cli
