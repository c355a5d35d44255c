// SPDX-License-Identifier: MIT
#include "harness/bench/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/digit_plan.hpp"
#include "harness/bench/dynamic_row.hpp"
#include "harness/bench/stage_bytes.hpp"

namespace octocell::bench {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kSchema = 2;

Json identity(const Group& group, const RowSpec& row) {
  const Implementation& how = row.how;
  return {{"name", row_name(row, group)},
          {"backend", how.backend->name},
          {"kind", how.is_baseline() ? "baseline" : "backend"},
          {"method", how.is_baseline() ? Json() : Json(how.method_name())},
          {"rule", how.has_rule() ? Json(name_of(how.rule)) : Json()},
          {"predicate", how.is_baseline() ? Json() : Json(name_of(how.predicate))},
          {"skips", row.skips.empty() ? Json() : Json(row.skips)},
          {"scene", group.scene},
          {"n", group.n},
          {"threads", row.threads},
          {"run", name_of(row.run)},
          {"negative_control", how.negative_control()},
          {"known_issues", how.has_known_issues() ? Json(how.backend->known_issues) : Json()}};
}

void add_answer(Json& json, const RowSpec& row, const RowResult& result) {
  const bool skipped = result.skipped.has_value();
  const auto unless_skipped = [skipped](auto value) { return skipped ? Json() : Json(value); };
  const auto if_any = [skipped](const std::optional<double>& value) {
    return skipped || !value ? Json() : Json(*value);
  };
  json["status"] = skipped ? "skipped" : result.wrong() ? "wrong" : "ok";
  json["reason"] = skipped ? Json(*result.skipped) : Json();
  json["pairs"] = unless_skipped(result.digest.count);
  json["checksum"] = unless_skipped(fmt::format("{:#018x}", result.digest.checksum));
  json["missed"] = unless_skipped(result.difference.missed);
  json["false"] = unless_skipped(result.difference.false_pairs);
  json["duplicates"] = unless_skipped(result.difference.duplicates);
  json["worst_missed_depth"] = if_any(result.difference.worst_missed_depth);
  json["worst_false_gap"] = if_any(result.difference.worst_false_gap);
  json["distinct_checksums"] = unless_skipped(result.distinct_checksums());
  json["candidates"] = unless_skipped(result.counts.candidates);
  json["uncertain_pairs"] =
      row.how.is_baseline() ? Json() : unless_skipped(result.counts.uncertain_pairs);
}

/// Returns what was chosen for the scene, and what was left out.
Json plan_of(const RowResult& result) {
  Json skips = Json::array();
  const Skips left_out = result.plan.taken.either(result.counts.used);
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    if (left_out.has(static_cast<Skip>(k))) skips.push_back(kSkips[k].name);
  }
  const Plan& plan = result.plan;
  const bool tiles = plan.method == Method::tiles;  // its levels are for what does not fit
  const bool has_ids = plan.method != Method::brute_force && !tiles;
  const int passes = has_ids ? sort_passes(plan.key_bits, plan.sort_digit_bits) : 0;
  return {{"method", name_of(plan.method)},
          {"levels", tiles ? 0 : plan.levels.count},
          {"key_bits", tiles ? 0 : plan.key_bits},
          {"sort_passes", passes},
          {"skips", skips}};
}

void add_times(Json& json, const Group& group, const RowSpec& row, const RowResult& result) {
  const Implementation& how = row.how;
  json["iterations"] = result.iterations;
  json["total_ms"] = result.total_ms;
  json["stage_ms"] = Json::object();
  for (const auto& [stage, times] : result.stage_ms) {
    json["stage_ms"][std::string(name_of(stage))] = times;
  }
  json["stage_bytes"] = Json::object();
  if (row.how.backend->device && !result.skipped) {
    for (const auto& [stage, bytes] : stage_bytes(result.plan.method, group.n, result.counts)) {
      json["stage_bytes"][std::string(name_of(stage))] = bytes;
    }
  }
  json["plan"] = how.is_baseline() || result.skipped ? Json() : plan_of(result);
  json["marked_total_ms"] = result.marked_total_ms;
  json["plan_ms"] = row.how.is_baseline() ? Json() : Json(result.plan_ms);
  json["fused"] = Json::object();
  for (const auto& [stage, holder] : result.fused) {
    json["fused"][std::string(name_of(stage))] = name_of(holder);
  }
  if (!result.frame_ms.empty()) {
    json["frames"] = {{"scene", group.scene},
                      {"warmup_frames", std::min(kWarmupFrames, result.frame_ms.front().size())},
                      {"frame_ms", result.frame_ms}};
  }
  json["peak_bytes"] = result.peak_bytes ? Json(*result.peak_bytes) : Json();
  json["device_bytes"] = result.device_bytes ? Json(*result.device_bytes) : Json();
  json["output_bytes"] = result.digest.count * sizeof(Pair);
}

}  // namespace

Results::Results(std::string path, Json context) : file_(std::move(path)) {
  context["finished"] = false;
  document_ = {{"schema", kSchema},
               {"context", std::move(context)},
               {"groups", Json::array()},
               {"rows", Json::array()}};
}

void Results::add_group(Json group) { document_["groups"].push_back(std::move(group)); }

void Results::add_row(const Group& group, const RowSpec& row, const RowResult& result) {
  Json json = identity(group, row);
  add_answer(json, row, result);
  add_times(json, group, row, result);
  document_["rows"].push_back(std::move(json));
}

}  // namespace octocell::bench
