// SPDX-License-Identifier: MIT
#include "harness/verify/stress/run.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octocell::stress {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 7> kAskNames = {
    "pairs", "count", "refusal", "buffers", "frames", "other_scenes", "repetition"};

void add(EntryResult& row, const Case& scene, const CaseVerdict& verdict) {
  ++row.cases[static_cast<std::size_t>(verdict.status)];
  row.difference.missed += verdict.difference.missed;
  row.difference.false_pairs += verdict.difference.false_pairs;
  row.difference.duplicates += verdict.difference.duplicates;
  row.spheres = std::max<std::uint64_t>(row.spheres, scene.spheres.size());
  row.pairs += verdict.pairs;
  row.candidates += verdict.candidates;
  if (verdict.status <= row.worst) return;
  row.worst = verdict.status;
  row.worst_case = scene.name;
  row.reason = verdict.reason;
}

/// One late case is enough: each of the entry's other cases would take the whole time limit again.
bool is_late(const EntryResult& row) { return row.with(Status::late) > 0; }

}  // namespace

Status EntryResult::status() const {
  return worst == Status::skipped && with(Status::exact) > 0 ? Status::exact : worst;
}

bool EntryResult::failed() const {
  return !how.is_baseline() && with(Status::wrong) + with(Status::crashed) + with(Status::late) > 0;
}

std::vector<EntryResult> run_entry(const Entry& entry, Size size,
                                   std::span<const Implementation> judged, const Limits& limits,
                                   bool (*stop)()) {
  std::vector<EntryResult> rows;
  for (const Implementation& how : judged) rows.push_back({.entry = &entry, .how = how});
  for (const Case& scene : entry.cases(entry.at(size))) {
    if (stop()) break;
    Truth truth = truth_of(entry, scene);
    for (EntryResult& row : rows) {
      if (is_late(row)) {
        add(row, scene, {.status = Status::skipped, .reason = "late before"});
        continue;
      }
      const auto begin = std::chrono::steady_clock::now();
      const CaseVerdict verdict = judge(row.how, entry.ask, scene, truth, limits);
      if (stop()) return rows;  // Ctrl-C ends a child, too, but that is not its crash
      row.seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      add(row, scene, verdict);
    }
  }
  return rows;
}

Json to_json(const EntryResult& row) {
  const Implementation& how = row.how;
  Json cases = Json::object();
  for (std::size_t k = 0; k < kStatusNames.size(); ++k)
    cases[std::string(kStatusNames[k])] = row.cases[k];
  return {{"entry", row.entry->id},
          {"implementation", how.label()},
          {"backend", how.backend->name},
          {"kind", how.is_baseline() ? "baseline" : "backend"},
          {"method", how.is_baseline() ? Json() : Json(how.method_name())},
          {"rule", how.has_rule() ? Json(name_of(how.rule)) : Json()},
          {"status", name_of(row.status())},
          {"cases", std::move(cases)},
          {"spheres", row.spheres},
          {"pairs", row.pairs},
          {"missed", row.difference.missed},
          {"false", row.difference.false_pairs},
          {"duplicates", row.difference.duplicates},
          {"candidates", row.candidates},
          {"worst_case", row.worst_case.empty() ? Json() : Json(row.worst_case)},
          {"reason", row.reason.empty() ? Json() : Json(row.reason)},
          {"seconds", row.seconds}};
}

Json to_json(const Entry& entry) {
  return {
      {"id", entry.id},
      {"name", entry.name},
      {"asks", kAskNames[static_cast<std::size_t>(entry.ask)]},
      {"sizes",
       {{"slice", entry.sizes.slice}, {"quick", entry.sizes.quick}, {"full", entry.sizes.full}}},
      {"not_run", entry.not_run.empty() ? Json() : Json(entry.not_run)}};
}

}  // namespace octocell::stress
