// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "core/text.hpp"
#include "harness/try/try.hpp"

namespace octocell::hand_in {
namespace {

using Json = nlohmann::ordered_json;

std::string last_line(std::string_view text) {
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  const std::size_t begin = text.rfind('\n');
  return printable(begin == std::string_view::npos ? text : text.substr(begin + 1));
}

/// What a function reads and what it writes, as a table and JSON name it.
struct Units {
  const char* n;
  const char* found;
};
constexpr Units units_of(Function function) {
  constexpr Units kUnits[] = {{"spheres", "pairs"},
                              {"spheres", "entries"},
                              {"entries", "sorted"},
                              {"entries", "cells"},
                              {"entries", "pairs"}};
  return kUnits[static_cast<std::size_t>(function)];
}

std::string scene_line(const TriedScene& scene, const Units& units) {
  return fmt::format("  {:<58} {:>8} {} {:>8} {}  {}\n", scene.spec, scene.n, units.n, scene.found,
                     units.found, scene.exact ? "exact" : "WRONG");
}

std::string text_of(const WrongEntry& wrong) {
  return fmt::format("first wrong  {} {}: expected {}, got {}\n", wrong.array, wrong.entry,
                     wrong.expected, wrong.got);
}

Json json_of(const WrongEntry& wrong) {
  return {{"array", wrong.array},
          {"entry", wrong.entry},
          {"expected", wrong.expected},
          {"got", wrong.got}};
}

}  // namespace

std::string to_text(const Trial& trial, std::string_view file) {
  std::string text;
  if (!trial.compiled_with.empty())
    text += fmt::format("compiled     {}\n", fmt::join(trial.compiled_with, " "));
  for (const TriedScene& scene : trial.scenes) text += scene_line(scene, units_of(trial.function));
  if (trial.wrong) text += fmt::format("\n{}\n", judge::to_text(*trial.wrong, trial.at, file));
  if (trial.wrong_entry) {
    text += fmt::format("\n{}", text_of(*trial.wrong_entry));
    text +=
        trial.cause ? judge::to_text(*trial.cause) : "cause        none of those that are known\n";
    text += "\n";
  }
  if (trial.cause && trial.cause_at != trial.at)
    text += fmt::format("on {}:\n{}\n", trial.cause_at, judge::to_text(*trial.cause));
  if (!trial.timed.empty()) text += to_text(trial.timed) + "\n";
  text += fmt::format("{}: {}", file, trial.verdict);
  const bool is_stage = trial.function != Function::find_pairs;
  if (is_stage) text += fmt::format(": stage {}", name_of(trial.function));
  if (trial.verdict == "exact") text += fmt::format(" on {} scenes", trial.scenes.size());
  if (trial.is_wrong()) text += fmt::format(" on {}; look at it first", trial.at);
  if (!trial.kind.empty()) {
    text += fmt::format(": {}{}: {}", trial.kind, trial.at.empty() ? "" : " on " + trial.at,
                        trial.reason);
    if (!trial.printed.empty())
      text += fmt::format("; the last that it printed: {}", last_line(trial.printed));
  }
  return text + "\n";
}

Json to_json(const Trial& trial, std::string_view file) {
  Json scenes = Json::array();
  for (const TriedScene& scene : trial.scenes) {
    scenes.push_back({{"scene", scene.spec},
                      {"n", scene.n},
                      {units_of(trial.function).found, scene.found},
                      {"verdict", scene.exact ? "exact" : "wrong"},
                      {"ms", scene.milliseconds},
                      {"class", kPartNames[static_cast<std::size_t>(scene.part)]}});
  }
  const Json wrong = trial.wrong ? judge::to_json(*trial.wrong, trial.at, file) : Json();
  Json first = trial.wrong ? wrong["first"] : Json::array();
  if (trial.wrong_entry) first.push_back(json_of(*trial.wrong_entry));
  return {{"file", file},
          {"function", name_of(trial.function)},
          {"verdict", trial.verdict},
          {"kind", trial.kind.empty() ? Json() : Json(trial.kind)},
          {"reason", trial.reason.empty() ? Json() : Json(trial.reason)},
          {"at", trial.at.empty() ? Json() : Json(trial.at)},
          {"printed", trial.printed.empty() ? Json() : Json(printable(trial.printed))},
          {"command", trial.compiled_with},
          {"scenes", std::move(scenes)},
          {"first", std::move(first)},
          {"cause", trial.cause ? judge::to_json(*trial.cause) : Json()},
          {"cause_at", trial.cause ? Json(trial.cause_at) : Json()},
          {"judgement", wrong},
          {"class", kPartNames[static_cast<std::size_t>(trial.part)]},
          {"bench", trial.timed.empty() ? Json() : to_json(trial.timed)}};
}

}  // namespace octocell::hand_in
