// SPDX-License-Identifier: MIT
#include "harness/judge/judge.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/planner/planner.hpp"
#include "harness/judge/hypotheses.hpp"
#include "harness/judge/scene_facts.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::judge {
namespace {

constexpr std::size_t kMostRight = 20'000;  // pairs that are right, for comparison
constexpr std::size_t kMostWrong = 20'000;
constexpr std::size_t kNearMisses = 5'000;  // spheres among which they are looked for

Evidence evidence_of(std::string_view kind, std::string_view right_kind,
                     std::span<const Pair> wrong, std::span<const Pair> right) {
  return {kind, right_kind, spread(wrong, kMostWrong), spread(right, kMostRight)};
}

/// Keeps the cause; otherwise notes if there was too little to tell.
bool note(Judgement& judgement, const Evidence& evidence, std::optional<Cause> cause) {
  if (!cause) {
    judgement.too_few_to_tell |= is_too_little(evidence);
    return false;
  }
  judgement.causes.push_back(std::move(*cause));
  return true;
}

void explain_missed(Judgement& judgement, const SceneFacts& facts) {
  const Differences& d = judgement.differences;
  if (d.missed.empty()) return;
  const Evidence evidence = evidence_of("missed", "true pairs that were found", d.missed, d.found);
  Hypotheses all;
  add_contact(all, facts);
  add_ids(all, facts);
  add_capacity(all, d, facts);
  add_coordinates(all, facts);
  add_cells(all, facts, d.missed.front());
  add_text_rules(all, facts);
  add_bounds(all, facts, d.missed);
  if (note(judgement, evidence, common_cause(evidence, all))) return;
  if (auto cause = round_number_of_rows(d, facts)) judgement.causes.push_back(std::move(*cause));
}

/// Pairs that are nearly pairs, and that the list rightly leaves out.
std::vector<Pair> near_misses(const Differences& differences, const SceneFacts& facts) {
  const std::size_t n = std::min(facts.spheres.size(), kNearMisses);
  std::vector<Sphere> enlarged(facts.spheres.begin(), facts.spheres.begin() + n);
  for (Sphere& s : enlarged) s.r = std::min(2.0F * s.r, s.r + facts.r_max);
  const std::vector<Pair> near = reference::exact_pairs(enlarged);
  std::vector<Pair> no_pairs;
  std::ranges::set_difference(near, facts.truth, std::back_inserter(no_pairs));
  std::vector<Pair> left_out;
  std::ranges::set_difference(no_pairs, differences.false_pairs, std::back_inserter(left_out));
  return left_out;
}

void explain_false(Judgement& judgement, const SceneFacts& facts) {
  const Differences& d = judgement.differences;
  if (d.false_pairs.empty()) return;
  const Evidence evidence =
      evidence_of("false", "near misses that were left out", d.false_pairs, near_misses(d, facts));
  Hypotheses all;
  add_false_tests(all, facts);
  add_ids(all, facts);
  add_coordinates(all, facts);
  note(judgement, evidence, common_cause(evidence, all));
}

void explain_repeated(Judgement& judgement, const SceneFacts& facts) {
  const Differences& d = judgement.differences;
  std::vector<Pair> repeated;
  for (const RepeatedPair& p : d.repeated) repeated.push_back(p.pair);
  if (repeated.empty()) return;
  std::vector<Pair> once;
  std::ranges::set_difference(d.found, repeated, std::back_inserter(once));
  const Evidence evidence =
      evidence_of("repeated", "true pairs that were found once", repeated, once);
  Hypotheses all;
  add_repeating_text_rules(all, facts);
  add_several_cells(all, facts);
  add_ids(all, facts);
  add_coordinates(all, facts);
  if (note(judgement, evidence, common_cause(evidence, all)))
    judgement.causes.back().kind = "duplicates";
}

bool has_cause(const Judgement& judgement, std::string_view kind) {
  return std::ranges::find(judgement.causes, kind, &Cause::kind) != judgement.causes.end();
}

void explain(Judgement& judgement, std::span<const ListedPair> list, const SceneFacts& facts) {
  judgement.causes = list_causes(list, judgement.differences, facts);
  if (has_cause(judgement, "list")) return;
  explain_missed(judgement, facts);
  explain_false(judgement, facts);
  if (!has_cause(judgement, "duplicates")) explain_repeated(judgement, facts);
  const auto rank = [](const Cause& cause) {
    return cause.kind == "missed" ? 0 : cause.kind == "false" ? 1 : 2;
  };
  std::ranges::stable_sort(judgement.causes, {}, rank);
}

/// Plans as `octocell why` does.
class Explainer {
 public:
  explicit Explainer(const Scene& scene)
      : scene_(scene), plan_(make_plan(measure(scene.view()), {.rule = Rule::lowest_cell})) {}

  [[nodiscard]] FirstWrong of(std::string kind, Pair pair, std::optional<std::size_t> row) const {
    FirstWrong first = {.kind = std::move(kind), .pair = {pair.i, pair.j}, .row = row};
    first.why = trace::why(plan_, scene_.view(), pair.i, pair.j);
    const float side = 1.5F * plan_.facts.r_max;
    const Sphere& a = scene_.spheres[pair.i];
    const Sphere& b = scene_.spheres[pair.j];
    const trace::TextRule text = {.side = side};
    const bool is_lost =
        first.kind == "missed" && side > 0.0F && trace::times_tested(text, a, b) == 0;
    if (is_lost) first.flaw = trace::flaw_of(text, a, b);
    return first;
  }

 private:
  const Scene& scene_;
  Plan plan_;
};

std::vector<FirstWrong> first_wrong_of(const Differences& d, std::span<const ListedPair> list,
                                       const Scene& scene) {
  std::vector<FirstWrong> first;
  if (d.exact()) return first;
  if (!d.missed.empty() || !d.false_pairs.empty() || !d.repeated.empty()) {
    const Explainer explain(scene);
    if (!d.missed.empty()) first.push_back(explain.of("missed", d.missed.front(), std::nullopt));
    if (!d.false_pairs.empty()) {
      const Pair pair = d.false_pairs.front();
      first.push_back(explain.of("false", pair, row_of(list, pair)));
    }
    if (!d.repeated.empty()) {
      const Pair pair = d.repeated.front().pair;
      first.push_back(explain.of("duplicates", pair, row_of(list, pair, 1)));
    }
  }
  if (!d.out_of_range.empty()) {
    const std::size_t row = d.out_of_range.front();
    first.push_back({.kind = "out_of_range", .pair = list[row], .row = row});
  }
  return first;
}

}  // namespace

Judgement judge(std::span<const ListedPair> list, const Scene& scene, std::span<const Pair> truth) {
  Judgement judgement = {
      .spheres = scene.spheres.size(),
      .true_pairs = truth.size(),
      .differences = differences_of(list, truth, scene.spheres.size()),
  };
  if (judgement.exact()) return judgement;
  judgement.first = first_wrong_of(judgement.differences, list, scene);
  explain(judgement, list, SceneFacts(scene.spheres, truth));
  return judgement;
}

Judgement judge(std::span<const ListedPair> list, const Scene& scene) {
  return judge(list, scene, reference::exact_pairs(scene));
}

}  // namespace octocell::judge
