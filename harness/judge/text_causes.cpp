// SPDX-License-Identifier: MIT
// The rule of a course text, word for word or with some of its mistakes mended, as the steps of
// course/pipeline mend them: what it loses and what it gives twice.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/judge/hypotheses.hpp"
#include "harness/trace/text_rule.hpp"

namespace octocell::judge {
namespace {

using trace::CellNumber;
using trace::TestedWhere;
using trace::TextRule;

constexpr float kRootOf2 = 1.41421366F;  // as in course/pipeline

struct SideChoice {
  float factor;
  const char* text;
};
constexpr SideChoice kSides[] = {{1.5F, "1.5 r_max"},
                                 {1.5F * 2 * kRootOf2, "3 sqrt 2 r_max"},
                                 {2.0F, "2 r_max"},
                                 {3.0F, "3 r_max"}};

struct IdChoice {
  CellNumber number;
  bool has_unique_ids;
  bool has_box;
  const char* text;
};
constexpr IdChoice kIds[] = {
    {CellNumber::saturated, false, false, "cells cast to unsigned"},
    {CellNumber::floored, false, true, "cells by floor, ids of 10-bit fields"},
    {CellNumber::floored, true, true, "cells by floor"},
    {CellNumber::truncated, true, false, "cells cast to int"},
};

struct TestChoice {
  TestedWhere tested;
  const char* text;
};
constexpr TestChoice kTests[] = {{TestedWhere::larger_home, ""},
                                 {TestedWhere::any_home, ", any home with its phantoms"},
                                 {TestedWhere::any_cell, ", any two in a cell"}};

trace::CellBox box_of(const TextRule& rule, const SceneFacts& facts) {
  const auto corner = [&](const std::array<float, 3>& p) {
    return trace::home_cell(rule, {p[0], p[1], p[2], 0.0F});
  };
  return {corner(facts.lowest), corner(facts.highest)};
}

struct NamedRule {
  TextRule rule;
  std::string text;
};

std::vector<NamedRule> rules_for(const SceneFacts& facts) {
  std::vector<NamedRule> all;
  if (!(facts.r_max > 0.0F)) return all;
  const auto add_all = [&](const SideChoice& side, const IdChoice& ids, const TestChoice& test) {
    for (const bool is_scaled : {false, true}) {
      for (const bool has_all_slots : {false, true}) {
        TextRule rule = {.side = side.factor * facts.r_max,
                         .scale = is_scaled ? kRootOf2 : 1.0F,
                         .number = ids.number,
                         .has_unique_ids = ids.has_unique_ids,
                         .has_all_slots = has_all_slots,
                         .tested = test.tested};
        if (ids.has_box) rule.box = box_of(rule, facts);
        all.push_back(
            {rule, fmt::format("side {}, {}{}{}{}", side.text, ids.text,
                               is_scaled ? ", balls scaled by sqrt 2" : "",
                               has_all_slots ? "" : ", eight slots a sphere", test.text)});
      }
    }
  };
  for (const TestChoice& test : kTests) {
    for (const SideChoice& side : kSides) {
      for (const IdChoice& ids : kIds) add_all(side, ids, test);
    }
  }
  return all;
}

void add(Hypotheses& all, const SceneFacts& facts, const char* text, bool (*is_wrong)(int times)) {
  for (const NamedRule& named : rules_for(facts)) {
    const auto rule = std::make_shared<const TextRule>(named.rule);
    all.push_back({.name = "rule of the course text",
                   .text = fmt::format("{} ({})", text, named.text),
                   .holds =
                       [rule, &facts, is_wrong](Pair pair) {
                         return is_wrong(trace::times_tested(*rule, facts.spheres[pair.i],
                                                             facts.spheres[pair.j]));
                       },
                   .part =
                       [rule, &facts](Pair pair) {
                         return trace::flaw_of(*rule, facts.spheres[pair.i], facts.spheres[pair.j]);
                       }});
  }
}

}  // namespace

void add_text_rules(Hypotheses& all, const SceneFacts& facts) {
  add(all, facts, "are lost by the course text's rule", [](int times) { return times == 0; });
}

void add_repeating_text_rules(Hypotheses& all, const SceneFacts& facts) {
  add(all, facts, "are met more than once by the course text's rule",
      [](int times) { return times > 1; });
}

}  // namespace octocell::judge
