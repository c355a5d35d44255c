// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "harness/engine/median.hpp"
#include "harness/try/bench.hpp"

namespace octocell::hand_in {
namespace {

using Json = nlohmann::ordered_json;

std::string row_text(const TimedRow& row) {
  if (row.milliseconds.empty()) return fmt::format("    {:<28} {}\n", row.name, row.ended);
  const auto [low, high] = std::ranges::minmax_element(row.milliseconds);
  return fmt::format("    {:<28} {:>10.3f} {:>10.3f} {:>10.3f}  {}\n", row.name,
                     median(row.milliseconds), *low, *high, row.ended);
}

Json row_json(const TimedRow& row) {
  Json json = {{"name", row.name},       {"ended", row.ended.empty() ? Json() : Json(row.ended)},
               {"ms", row.milliseconds}, {"median", nullptr},
               {"low", nullptr},         {"high", nullptr}};
  if (row.milliseconds.empty()) return json;
  const auto [low, high] = std::ranges::minmax_element(row.milliseconds);
  json["median"] = median(row.milliseconds);
  json["low"] = *low;
  json["high"] = *high;
  return json;
}

}  // namespace

std::string to_text(const std::vector<TimedScene>& scenes) {
  std::string text = fmt::format("\n{:<32} {:>10} {:>10} {:>10}\n",
                                 "milliseconds, new spheres each time", "median", "least", "most");
  for (const TimedScene& scene : scenes) {
    text += fmt::format("  {}, {} spheres, {} times\n", scene.kind, scene.n,
                        scene.rows.empty() ? 0 : scene.rows.front().milliseconds.size());
    for (const TimedRow& row : scene.rows) text += row_text(row);
  }
  return text;
}

Json to_json(const std::vector<TimedScene>& scenes) {
  Json json = Json::array();
  for (const TimedScene& scene : scenes) {
    Json rows = Json::array();
    for (const TimedRow& row : scene.rows) rows.push_back(row_json(row));
    json.push_back({{"scene", scene.kind}, {"n", scene.n}, {"rows", std::move(rows)}});
  }
  return json;
}

}  // namespace octocell::hand_in
