// SPDX-License-Identifier: MIT
#include "harness/try/try.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "core/available_memory.hpp"
#include "core/text.hpp"
#include "harness/files/save.hpp"
#include "harness/try/child.hpp"
#include "harness/try/compile.hpp"
#include "harness/try/task.hpp"

namespace octocell::hand_in {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

std::unique_ptr<Task> make_task(const Options& options) {
  if (options.function == Function::find_pairs) return make_pairs_task(options.seed);
  return make_stage_task(options.function);
}

/// Returns the line that says what a sanitizer found; empty if there is none.
std::string sanitizer_line(std::string_view printed) {
  for (const std::string_view mark : {"runtime error: ", "SUMMARY: ", "========= Invalid "}) {
    const std::size_t at = printed.find(mark);
    if (at == std::string_view::npos) continue;
    const std::size_t begin = printed.rfind('\n', at) + 1;  // 0 if there is no line before
    return printable(printed.substr(begin, printed.find('\n', at) - begin));
  }
  return {};
}

/// One run over the scenes.
class Run {
 public:
  Run(Trial& trial, const Options& options, const Program& program)
      : trial_(trial),
        options_(options),
        task_(make_task(options)),
        child_(program, limits_of(options)) {}

  void try_all() {
    for (const TrialScene& scene : task_->scenes(options_.seed)) {
      if (scene.is_within_budget() && left() <= 0.0) return;
      trial_.part = scene.part;
      if (!try_one(scene)) return;
    }
  }

 private:
  /// Returns false if no more scenes should be tried.
  bool try_one(const TrialScene& scene) {
    const bool is_larger = scene.part == Part::larger;
    const double limit = is_larger ? std::min(options_.timeout_s, left()) : options_.timeout_s;
    try {
      task_->try_scene(child_, scene, Seconds(std::max(limit, 0.1)), trial_);
    } catch (const CannotJudge& late) {
      // A slow program is no wrong one: the budget ends here.
      if (is_larger && late.kind == "hangs") return false;
      throw;
    }
    if (!trial_.is_wrong()) return true;
    if (!trial_.cause) look_for_cause();
    return false;
  }

  void look_for_cause() {
    try {
      task_->look_for_cause(child_, Seconds(options_.timeout_s), trial_);
    } catch (const CannotJudge&) {
      // It stays without a cause.
    }
  }

  [[nodiscard]] double left() const {
    return options_.budget_s - Seconds(Clock::now() - begin_).count();
  }

  Trial& trial_;
  const Options& options_;
  std::unique_ptr<Task> task_;
  Child child_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

Limits limits_of(const Options& options) {
  return {.memory_bytes = options.memory_gib * kGiB,
          .start = Seconds(std::max(options.timeout_s, 60.0))};
}

void note_cause(const judge::Judgement& judgement, const Scene& scene, Trial& trial) {
  if (judgement.causes.empty()) return;
  trial.cause = judgement.causes.front();
  trial.cause_at = scene.spec;
}

Trial try_hand_in(const Options& options) {
  const TemporaryFolder folder;
  Trial trial = {.function = options.function, .verdict = "cannot be judged"};
  std::optional<Run> run;
  try {
    const Program program =
        prepare_program(options.file, options.function, options.python, options.sanitize, folder);
    trial.compiled_with = program.compiled_with;
    run.emplace(trial, options, program);
    run->try_all();
    if (options.bench && !trial.is_wrong()) {
      run.reset();  // no other process of it while it is timed
      trial.timed = bench(program, options, trial);
    }
    trial.verdict = trial.is_wrong() ? "wrong" : "exact";
  } catch (const CannotJudge& failure) {
    trial.kind = failure.kind;
    trial.reason = failure.what();
    trial.printed = failure.printed;
    const std::string found = options.sanitize ? sanitizer_line(failure.printed) : "";
    if (!found.empty()) {
      trial.kind = "sanitizer";
      trial.reason = found;
    }
  }
  if (!options.save.empty() && !trial.wrong_spheres.empty())
    save_scene(options.save, trial.wrong_spheres);
  return trial;
}

}  // namespace octocell::hand_in
