// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "harness/judge/judge.hpp"

namespace octocell::judge {
namespace {

using Json = nlohmann::ordered_json;

std::string counts_line(const Differences& d) {
  return fmt::format("wrong        missed {}, false {}, duplicates {}, out of range {}\n",
                     d.missed.size(), d.false_pairs.size(), d.duplicates, d.out_of_range.size());
}

std::string name_of_kind(const std::string& kind) {
  return kind == "duplicates" ? "duplicate" : kind == "out_of_range" ? "out of range" : kind;
}

std::string text_of(const FirstWrong& first, std::string_view scene) {
  std::string text =
      fmt::format("first {}: {} {}", name_of_kind(first.kind), first.pair.i, first.pair.j);
  if (first.row) text += fmt::format(", in row {}", *first.row);
  text += '\n';
  if (!first.why) return text;
  const trace::Overlap& o = first.why->overlap;
  text += fmt::format("  overlap    {}: distance {:.9g}, sum of the radii {:.9g}{}\n",
                      o.answer ? "yes" : "no", o.distance, o.radius_sum,
                      first.why->may_collide ? "" : ", but by their flags they do not collide");
  for (const trace::Meeting& m : first.why->meetings) {
    if (!m.tested) continue;
    text += fmt::format("  meet       in cell ({}, {}, {}) of {}\n", m.cell.x, m.cell.y, m.cell.z,
                        first.why->cells);
  }
  if (first.flaw) {
    text += fmt::format("  as written the course text's rule loses it, too: {}: {}\n",
                        first.flaw->name, first.flaw->explanation);
  }
  return text + fmt::format("  more       {}\n", why_command(first, scene));
}

Json to_json(const FirstWrong& first, std::string_view scene) {
  const bool is_pair = first.why.has_value();
  return {{"kind", first.kind},
          {"i", first.pair.i},
          {"j", first.pair.j},
          {"row", first.row ? Json(*first.row) : Json()},
          {"why", is_pair ? trace::to_json(*first.why, scene) : Json()},
          {"flaw", first.flaw
                       ? Json{{"name", first.flaw->name}, {"explanation", first.flaw->explanation}}
                       : Json()},
          {"command", is_pair ? Json(why_command(first, scene)) : Json()}};
}

}  // namespace

std::string to_text(const Cause& cause) {
  std::string text = fmt::format("cause        {}: {}\n", cause.name, cause.text);
  for (const CausePart& part : cause.parts)
    text += fmt::format("  {:<10} {}: {}\n", part.count, part.flaw.name, part.flaw.explanation);
  return text;
}

Json to_json(const Cause& cause) {
  Json parts = Json::array();
  for (const CausePart& part : cause.parts) {
    parts.push_back(
        {{"name", part.flaw.name}, {"explanation", part.flaw.explanation}, {"count", part.count}});
  }
  return {{"kind", cause.kind},       {"name", cause.name},   {"text", cause.text},
          {"wrong", cause.wrong},     {"right", cause.right}, {"right_with", cause.right_with},
          {"parts", std::move(parts)}};
}

std::string why_command(const FirstWrong& first, std::string_view scene) {
  return fmt::format("octocell why {} {} {}{}", scene, first.pair.i, first.pair.j,
                     first.flaw ? " --rule as_written" : "");
}

std::string to_text(const Judgement& j, std::string_view scene, std::string_view list) {
  std::string text =
      fmt::format("scene        {} ({} spheres, {} pairs)\nlist         {} ({} rows)\n", scene,
                  j.spheres, j.true_pairs, list, j.differences.listed);
  if (j.exact()) return text + "exact        every pair once, and no other\n";
  text += counts_line(j.differences);
  for (const FirstWrong& first : j.first) text += text_of(first, scene);
  for (const Cause& cause : j.causes) text += to_text(cause);
  if (!j.causes.empty() && !j.too_few_to_tell) return text;
  return text + (j.too_few_to_tell
                     ? "cause        too few pairs to tell; a larger scene shows more\n"
                     : "cause        none that all of them have in common\n");
}

Json to_json(const Judgement& j, std::string_view scene, std::string_view list) {
  const Differences& d = j.differences;
  Json first = Json::array();
  for (const FirstWrong& wrong : j.first) first.push_back(to_json(wrong, scene));
  Json causes = Json::array();
  for (const Cause& cause : j.causes) causes.push_back(to_json(cause));
  return {{"scene", scene},
          {"list", list},
          {"n", j.spheres},
          {"pairs", j.true_pairs},
          {"rows", d.listed},
          {"verdict", j.exact() ? "exact" : "wrong"},
          {"missed", d.missed.size()},
          {"false", d.false_pairs.size()},
          {"duplicates", d.duplicates},
          {"out_of_range", d.out_of_range.size()},
          {"first", std::move(first)},
          {"cause", j.causes.empty() ? Json() : causes.front()},
          {"causes", causes}};
}

}  // namespace octocell::judge
