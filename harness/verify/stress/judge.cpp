// SPDX-License-Identifier: MIT
#include "harness/verify/stress/judge.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/isolate.hpp"
#include "harness/verify/stress/earlier.hpp"

namespace octocell::stress {
namespace {

using Create = std::function<std::unique_ptr<PairFinder>()>;

struct Answer {
  Counts counts;
  PairDigest digest;
  std::vector<Pair> pairs;
};

/// One implementation, one case, and what is required: the data that the functions below share.
struct Trial {
  const Implementation& how;
  const Case& scene;
  Truth& truth;
  const Limits& limits;

  [[nodiscard]] PlanOptions options() const {
    PlanOptions options = how.plan_options(limits.threads);
    options.candidate_limit = how.is_baseline() ? limits.library_candidates : limits.candidates;
    return options;
  }
};

Answer find_here(PairFinder& finder, SceneView scene, const PlanOptions& options) {
  Answer answer = {find_completely(finder, scene, options).counts, {}, {}};
  if (answer.counts.over_candidate_limit) return answer;
  answer.digest = finder.digest();
  if (!options.count_only) answer.pairs = finder.download();
  return answer;
}

Answer find(const Trial& trial, const Create& create, const PlanOptions& options) {
  const SceneView scene = trial.scene.view();
  if (!trial.how.is_baseline()) return find_here(*create(), scene, options);
  IsolatedAnswer answer = find_isolated(create, scene, options, trial.limits.library_time);
  return {answer.counts, answer.digest, std::move(answer.pairs)};
}

Verdict wrong(std::string reason) { return {.status = Status::wrong, .reason = std::move(reason)}; }

Verdict compared(const Trial& trial, const Answer& answer) {
  Verdict verdict = {.pairs = answer.digest.count, .candidates = answer.counts.candidates};
  if (answer.counts.over_candidate_limit) {
    verdict.status = Status::skipped;
    verdict.reason = fmt::format("{} candidates", answer.counts.candidates);
    return verdict;
  }
  verdict.difference = reference::compare(answer.pairs, trial.truth.pairs);
  if (!verdict.difference.exact()) {
    verdict.status = Status::wrong;
    verdict.reason = fmt::format("missed {}, false {}, duplicates {}", verdict.difference.missed,
                                 verdict.difference.false_pairs, verdict.difference.duplicates);
  } else if (answer.digest != *trial.truth.digest) {
    return wrong("the digest is not that of the pairs");
  }
  return verdict;
}

/// Judges the scene as planned. If its lattice lets the plan skip uncertain pairs, judges it again
/// with them.
Verdict judge_pairs(const Trial& trial) {
  Verdict verdict = compared(trial, find(trial, trial.how.backend->create, trial.options()));
  if (verdict.status == Status::exact && !trial.how.is_baseline()) {
    PlanOptions uncertain = trial.options();
    uncertain.allowed = uncertain.allowed.without(Skip::uncertain_pairs).without(Skip::equal_radii);
    verdict = compared(trial, find(trial, trial.how.backend->create, uncertain));
    if (verdict.status == Status::wrong)
      verdict.reason += " (skips uncertain pairs, equal_radii forbidden)";
  }
  if (!trial.how.has_rule() || trial.how.rule != Rule::lowest_cell) return verdict;
  for (const double side : trial.scene.cell_sides) {
    if (verdict.status != Status::exact) return verdict;
    PlanOptions options = trial.options();
    options.cell_side = side;
    try {
      verdict = compared(trial, find(trial, trial.how.backend->create, options));
    } catch (const LimitError&) {
      continue;  // more cells than can be counted, so the refusal is right
    }
    if (verdict.status == Status::wrong) verdict.reason += fmt::format(" (cell side {:g})", side);
  }
  return verdict;
}

/// Libraries cannot count without storing.
Verdict judge_count(const Trial& trial) {
  if (trial.how.is_baseline()) return {.status = Status::skipped, .reason = "stores its pairs"};
  PlanOptions options = trial.options();
  options.count_only = true;
  const Answer answer = find(trial, trial.how.backend->create, options);
  if (answer.counts.over_candidate_limit) return compared(trial, answer);
  if (answer.digest.count != *trial.scene.pair_count) {
    return wrong(fmt::format("{} pairs, and not {}", answer.digest.count, *trial.scene.pair_count));
  }
  if (!trial.truth.digest) trial.truth.digest = answer.digest;
  if (answer.digest != *trial.truth.digest) return wrong("another checksum than the others'");
  return {.pairs = answer.digest.count, .candidates = answer.counts.candidates};
}

/// Libraries get their spheres unchecked: the driver checks them only for our backends.
Verdict judge_refusal(const Trial& trial) {
  if (trial.how.is_baseline())
    return {.status = Status::skipped, .reason = "takes its input unseen"};
  try {
    find(trial, trial.how.backend->create, trial.options());
  } catch (const InputError& refusal) {
    const std::string expected = fmt::format("sphere {}", *trial.scene.bad_sphere);
    const std::string what = refusal.what();
    const std::size_t at = what.find(expected);
    const bool named = at != std::string::npos && !std::isdigit(what[at + expected.size()]);
    return named ? Verdict{} : wrong("refused without its index: " + what);
  }
  return wrong("accepted");
}

/// Gives room for all pairs, for one less, and for none. The required size must be reported each
/// time, and nothing may be clipped.
Verdict judge_buffers(const Trial& trial) {
  if (trial.how.is_baseline()) return judge_pairs(trial);
  const std::uint64_t needed = trial.truth.pairs.size();
  const std::unique_ptr<PairFinder> finder = trial.how.backend->create();
  const Plan complete = find_completely(*finder, trial.scene.view(), trial.options()).plan;
  for (const std::uint64_t room : {std::uint64_t{0}, needed - 1, needed}) {
    Plan plan = complete;
    plan.capacity.pairs = room;
    const std::unique_ptr<StageClock> clock = finder->make_clock(Marks::off);
    finder->upload(plan, trial.scene.view());
    finder->find_pairs(*clock);
    const Counts counts = finder->counts();
    if (counts.pairs != needed) {
      return wrong(fmt::format("with room for {} it needs {} pairs, and not {}", room, counts.pairs,
                               needed));
    }
  }
  return compared(trial, {finder->counts(), finder->digest(), finder->download()});
}

Verdict judge_frames(const Trial& trial) {
  PlanOptions options = trial.options();
  options.moving = true;
  const Create create = [&trial] {
    return std::make_unique<AfterFrames>(trial.how.backend->create(), trial.scene.before);
  };
  return compared(trial, find(trial, create, options));
}

Verdict judge_other_scenes(const Trial& trial) {
  const PlanOptions options = trial.options();
  const Create create = [&] {
    return std::make_unique<AfterScenes>(trial.how.backend->create(), trial.scene.before, options);
  };
  return compared(trial, find(trial, create, options));
}

/// Uses new finders, for every number of threads. A library, which has one thread, runs once.
Verdict judge_repetition(const Trial& trial) {
  if (trial.how.is_baseline()) return judge_pairs(trial);
  std::vector<int> threads = {1};
  if (trial.how.backend->threaded) threads = {1, 2, 3, 7, trial.limits.threads};
  Verdict verdict;
  for (const int count : threads) {
    PlanOptions options = trial.options();
    options.threads = count;
    for (int run = 0; run < trial.limits.repetitions; ++run) {
      verdict = compared(trial, find(trial, trial.how.backend->create, options));
      if (verdict.status != Status::exact) {
        verdict.reason += fmt::format(" (run {} on {} threads)", run, count);
        return verdict;
      }
    }
  }
  return verdict;
}

Verdict judge_as_asked(Ask ask, const Trial& trial) {
  switch (ask) {
    case Ask::pairs:
      return judge_pairs(trial);
    case Ask::count:
      return judge_count(trial);
    case Ask::refusal:
      return judge_refusal(trial);
    case Ask::buffers:
      return judge_buffers(trial);
    case Ask::frames:
      return judge_frames(trial);
    case Ask::other_scenes:
      return judge_other_scenes(trial);
    case Ask::repetition:
      return judge_repetition(trial);
  }
  return wrong("nothing was asked");
}

/// Returns true for implementations that promise an answer for every valid scene.
bool must_answer(const Implementation& how) {
  return !how.is_baseline() && (!how.has_rule() || how.rule == Rule::lowest_cell);
}

Status status_of_refusal(const Implementation& how, std::string_view reason) {
  if (reason.starts_with("no answer within")) return Status::late;
  if (reason.starts_with("crashed with") || reason.starts_with("ended with"))
    return Status::crashed;
  return must_answer(how) ? Status::wrong : Status::refused;
}

}  // namespace

Truth truth_of(const Entry& entry, const Case& scene) {
  if (entry.ask == Ask::count || entry.ask == Ask::refusal) return {};
  Truth truth = {.pairs = reference::exact_pairs(scene.spheres, scene.flags), .digest = {}};
  truth.digest = digest_of(truth.pairs);
  if (scene.pair_count && truth.pairs.size() != *scene.pair_count) {
    throw Error(fmt::format("{} ({}): the oracle has {} pairs, the formula {}", entry.id,
                            scene.name, truth.pairs.size(), *scene.pair_count));
  }
  if (scene.pairs && truth.pairs != *scene.pairs) {
    throw Error(
        fmt::format("{} ({}): the oracle does not keep the relation", entry.id, scene.name));
  }
  return truth;
}

Verdict judge(const Implementation& how, Ask ask, const Case& scene, Truth& truth,
              const Limits& limits) {
  const Trial trial = {how, scene, truth, limits};
  try {
    return judge_as_asked(ask, trial);
  } catch (const LimitError& limit) {
    return {.status = status_of_refusal(how, limit.what()), .reason = limit.what()};
  } catch (const Error& error) {
    return wrong(error.what());
  }
}

}  // namespace octocell::stress
