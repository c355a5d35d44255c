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
#include "harness/engine/finder_answer.hpp"
#include "harness/engine/isolate.hpp"
#include "harness/verify/stress/earlier.hpp"

namespace octocell::stress {
namespace {

using Create = std::function<std::unique_ptr<PairFinder>()>;

/// One implementation, one case, and what is required: the data that the functions below share.
struct Attempt {
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

FinderAnswer find_here(PairFinder& finder, SceneView scene, const PlanOptions& options) {
  FinderAnswer answer = {find_completely(finder, scene, options).counts, {}, {}};
  if (answer.counts.over_candidate_limit) return answer;
  answer.digest = finder.digest();
  if (!options.count_only) answer.pairs = finder.download();
  return answer;
}

FinderAnswer find(const Attempt& attempt, const Create& create, const PlanOptions& options) {
  const SceneView scene = attempt.scene.view();
  if (!attempt.how.is_baseline()) return find_here(*create(), scene, options);
  return find_isolated(create, scene, options, attempt.limits.library_time);
}

CaseVerdict wrong(std::string reason) {
  return {.status = Status::wrong, .reason = std::move(reason)};
}

CaseVerdict compared(const Attempt& attempt, const FinderAnswer& answer) {
  CaseVerdict verdict = {.pairs = answer.digest.count, .candidates = answer.counts.candidates};
  if (answer.counts.over_candidate_limit) {
    verdict.status = Status::skipped;
    verdict.reason = fmt::format("{} candidates", answer.counts.candidates);
    return verdict;
  }
  verdict.difference = reference::compare(answer.pairs, attempt.truth.pairs);
  if (!verdict.difference.exact()) {
    verdict.status = Status::wrong;
    verdict.reason = fmt::format("missed {}, false {}, duplicates {}", verdict.difference.missed,
                                 verdict.difference.false_pairs, verdict.difference.duplicates);
  } else if (answer.digest != *attempt.truth.digest) {
    return wrong("the digest is not that of the pairs");
  }
  return verdict;
}

/// Judges the scene as planned. If its lattice lets the plan skip uncertain pairs, judges it again
/// with them.
CaseVerdict judge_pairs(const Attempt& attempt) {
  CaseVerdict verdict =
      compared(attempt, find(attempt, attempt.how.backend->create, attempt.options()));
  if (verdict.status == Status::exact && !attempt.how.is_baseline()) {
    PlanOptions uncertain = attempt.options();
    uncertain.allowed = uncertain.allowed.without(Skip::uncertain_pairs).without(Skip::equal_radii);
    verdict = compared(attempt, find(attempt, attempt.how.backend->create, uncertain));
    if (verdict.status == Status::wrong)
      verdict.reason += " (skips uncertain pairs, equal_radii forbidden)";
  }
  if (!attempt.how.has_rule() || attempt.how.rule != Rule::lowest_cell) return verdict;
  for (const double side : attempt.scene.cell_sides) {
    if (verdict.status != Status::exact) return verdict;
    PlanOptions options = attempt.options();
    options.cell_side = side;
    try {
      verdict = compared(attempt, find(attempt, attempt.how.backend->create, options));
    } catch (const LimitError&) {
      continue;  // more cells than can be counted, so the refusal is right
    }
    if (verdict.status == Status::wrong) verdict.reason += fmt::format(" (cell side {:g})", side);
  }
  return verdict;
}

/// Libraries cannot count without storing.
CaseVerdict judge_count(const Attempt& attempt) {
  if (attempt.how.is_baseline()) return {.status = Status::skipped, .reason = "stores its pairs"};
  PlanOptions options = attempt.options();
  options.count_only = true;
  const FinderAnswer answer = find(attempt, attempt.how.backend->create, options);
  if (answer.counts.over_candidate_limit) return compared(attempt, answer);
  if (answer.digest.count != *attempt.scene.pair_count) {
    return wrong(
        fmt::format("{} pairs, and not {}", answer.digest.count, *attempt.scene.pair_count));
  }
  if (!attempt.truth.digest) attempt.truth.digest = answer.digest;
  if (answer.digest != *attempt.truth.digest) return wrong("another checksum than the others'");
  return {.pairs = answer.digest.count, .candidates = answer.counts.candidates};
}

/// Libraries get their spheres unchecked: the driver checks them only for our backends.
CaseVerdict judge_refusal(const Attempt& attempt) {
  if (attempt.how.is_baseline())
    return {.status = Status::skipped, .reason = "takes its input unseen"};
  try {
    find(attempt, attempt.how.backend->create, attempt.options());
  } catch (const InputError& refusal) {
    const std::string expected = fmt::format("sphere {}", *attempt.scene.bad_sphere);
    const std::string what = refusal.what();
    const std::size_t at = what.find(expected);
    const bool named = at != std::string::npos && !std::isdigit(what[at + expected.size()]);
    return named ? CaseVerdict{} : wrong("refused without its index: " + what);
  }
  return wrong("accepted");
}

/// Gives room for all pairs, for one less, and for none. The required size must be reported each
/// time, and nothing may be clipped.
CaseVerdict judge_buffers(const Attempt& attempt) {
  if (attempt.how.is_baseline()) return judge_pairs(attempt);
  const std::uint64_t needed = attempt.truth.pairs.size();
  const std::unique_ptr<PairFinder> finder = attempt.how.backend->create();
  const Plan complete = find_completely(*finder, attempt.scene.view(), attempt.options()).plan;
  for (const std::uint64_t room : {std::uint64_t{0}, needed - 1, needed}) {
    Plan plan = complete;
    plan.capacity.pairs = room;
    const std::unique_ptr<StageClock> clock = finder->make_clock(Marks::off);
    finder->upload(plan, attempt.scene.view());
    finder->find_pairs(*clock);
    const Counts counts = finder->counts();
    if (counts.pairs != needed) {
      return wrong(fmt::format("with room for {} it needs {} pairs, and not {}", room, counts.pairs,
                               needed));
    }
  }
  return compared(attempt, {finder->counts(), finder->digest(), finder->download()});
}

CaseVerdict judge_frames(const Attempt& attempt) {
  PlanOptions options = attempt.options();
  options.moving = true;
  const Create create = [&attempt] {
    return std::make_unique<AfterFrames>(attempt.how.backend->create(), attempt.scene.before);
  };
  return compared(attempt, find(attempt, create, options));
}

CaseVerdict judge_other_scenes(const Attempt& attempt) {
  const PlanOptions options = attempt.options();
  const Create create = [&] {
    return std::make_unique<AfterScenes>(attempt.how.backend->create(), attempt.scene.before,
                                         options);
  };
  return compared(attempt, find(attempt, create, options));
}

/// Uses new finders, for every number of threads. A library, which has one thread, runs once.
CaseVerdict judge_repetition(const Attempt& attempt) {
  if (attempt.how.is_baseline()) return judge_pairs(attempt);
  std::vector<int> threads = {1};
  if (attempt.how.backend->threaded) threads = {1, 2, 3, 7, attempt.limits.threads};
  CaseVerdict verdict;
  for (const int count : threads) {
    PlanOptions options = attempt.options();
    options.threads = count;
    for (int run = 0; run < attempt.limits.repetitions; ++run) {
      verdict = compared(attempt, find(attempt, attempt.how.backend->create, options));
      if (verdict.status != Status::exact) {
        verdict.reason += fmt::format(" (run {} on {} threads)", run, count);
        return verdict;
      }
    }
  }
  return verdict;
}

CaseVerdict judge_as_asked(Ask ask, const Attempt& attempt) {
  switch (ask) {
    case Ask::pairs:
      return judge_pairs(attempt);
    case Ask::count:
      return judge_count(attempt);
    case Ask::refusal:
      return judge_refusal(attempt);
    case Ask::buffers:
      return judge_buffers(attempt);
    case Ask::frames:
      return judge_frames(attempt);
    case Ask::other_scenes:
      return judge_other_scenes(attempt);
    case Ask::repetition:
      return judge_repetition(attempt);
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

CaseVerdict judge(const Implementation& how, Ask ask, const Case& scene, Truth& truth,
                  const Limits& limits) {
  const Attempt attempt = {how, scene, truth, limits};
  try {
    return judge_as_asked(ask, attempt);
  } catch (const LimitError& limit) {
    return {.status = status_of_refusal(how, limit.what()), .reason = limit.what()};
  } catch (const Error& error) {
    return wrong(error.what());
  }
}

}  // namespace octocell::stress
