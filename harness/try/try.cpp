// SPDX-License-Identifier: MIT
#include "harness/try/try.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "harness/scenes/scenes.hpp"
#include "harness/try/child.hpp"
#include "harness/try/compile.hpp"
#include "harness/try/trial_scenes.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::hand_in {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kGiB = 1073741824.0;

Scene make_scene(const TrialScene& trial) {
  if (!trial.spec.empty()) return generate(trial.spec);
  Scene scene;
  scene.name = scene.spec = "no spheres";
  return scene;
}

/// More pairs than any hand-in with a reasonable mistake gives.
std::uint64_t most_pairs(std::size_t truth) { return 20 * truth + 2'000'000; }

std::uint64_t capacity_for(const TrialScene& trial, std::size_t spheres) {
  return trial.has_little_room ? 100 : 16 * spheres + 16;
}

/// One run over the scenes.
class Run {
 public:
  Run(Trial& trial, const Options& options, const Program& program)
      : trial_(trial),
        options_(options),
        child_(program.command, {.memory_bytes = options.memory_gib * kGiB,
                                 .start = Seconds(std::max(options.timeout_s, 60.0))}) {}

  void try_all() {
    for (const TrialScene& scene : trial_scenes(options_.seed)) {
      if (scene.is_larger && left() <= 0.0) return;
      if (!try_one(scene)) return;
    }
  }

 private:
  /// Returns false if no more scenes should be tried.
  bool try_one(const TrialScene& trial_scene) {
    const Scene scene = make_scene(trial_scene);
    trial_.at = scene.spec;
    const std::vector<Pair> truth = reference::exact_pairs(scene);
    const double limit =
        trial_scene.is_larger ? std::min(options_.timeout_s, left()) : options_.timeout_s;
    const auto asked = Clock::now();
    std::vector<ListedPair> pairs;
    try {
      pairs = child_.ask(scene.spheres, capacity_for(trial_scene, scene.spheres.size()),
                         most_pairs(truth.size()), Seconds(std::max(limit, 0.1)));
    } catch (const CannotJudge& late) {
      // A slow program is no wrong one: the budget ends here.
      if (trial_scene.is_larger && late.kind == "hangs") return false;
      throw;
    }
    const Seconds taken = Clock::now() - asked;
    judge::Judgement judgement = judge::judge(pairs, scene, truth);
    trial_.scenes.push_back(
        {scene.spec, scene.spheres.size(), truth.size(), judgement.exact(), 1e3 * taken.count()});
    if (judgement.exact()) return true;
    note_cause(judgement, scene);
    trial_.wrong = std::move(judgement);
    if (!trial_.cause) look_for_cause();
    return false;
  }

  void note_cause(const judge::Judgement& judgement, const Scene& scene) {
    if (judgement.causes.empty()) return;
    trial_.cause = judgement.causes.front();
    trial_.cause_at = scene.spec;
  }

  /// A small scene has too few pairs to tell what they have in common.
  void look_for_cause() {
    for (const std::string& spec : telling_scenes(options_.seed)) {
      const Scene scene = generate(spec);
      const std::vector<Pair> truth = reference::exact_pairs(scene);
      try {
        const auto pairs = child_.ask(scene.spheres, capacity_for({spec}, scene.spheres.size()),
                                      most_pairs(truth.size()), Seconds(options_.timeout_s));
        note_cause(judge::judge(pairs, scene, truth), scene);
      } catch (const CannotJudge&) {
        return;
      }
      if (trial_.cause) return;
    }
  }

  [[nodiscard]] double left() const {
    return options_.budget_s - Seconds(Clock::now() - begin_).count();
  }

  Trial& trial_;
  const Options& options_;
  Child child_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

Trial try_hand_in(const Options& options) {
  const TemporaryFolder folder;
  Trial trial = {.verdict = "cannot be judged"};
  std::optional<Run> run;
  try {
    const Program program = prepare_program(options.file, options.python, folder);
    trial.compiled_with = program.compiled_with;
    run.emplace(trial, options, program);
    run->try_all();
    trial.verdict = trial.wrong ? "wrong" : "exact";
  } catch (const CannotJudge& failure) {
    trial.kind = failure.kind;
    trial.reason = failure.what();
    trial.printed = failure.printed;
  }
  return trial;
}

}  // namespace octocell::hand_in
