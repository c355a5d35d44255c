// SPDX-License-Identifier: MIT
#include "harness/judge/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace octocell::judge {
namespace {

/// A random loss gets a cause at most this often, over about a thousand hypotheses.
constexpr double kMostChance = 0.01;
constexpr double kHypotheses = 1000.0;
/// A flaw that most right pairs have, too, explains nothing.
constexpr double kMostRight = 0.5;
/// Of a flaw that spoils all pairs for which it holds, one right pair for so many wrong ones is a
/// matter of rounding.
constexpr std::uint64_t kMostContrary = 20;

/// Returns the logarithm of the chance that `wrong` pairs, drawn at random from all, have something
/// in common that `right_with` of the `right` others have, too.
double log_chance(std::size_t wrong, std::size_t right_with, std::size_t right) {
  double sum = 0.0;
  const double have = static_cast<double>(wrong + right_with);
  const double all = static_cast<double>(wrong + right);
  for (std::size_t k = 0; k < wrong; ++k)
    sum += std::log((have - static_cast<double>(k)) / (all - static_cast<double>(k)));
  return sum;
}

std::vector<CausePart> parts_of(const Hypothesis& hypothesis, std::span<const Pair> wrong) {
  if (!hypothesis.part) return {};
  std::vector<CausePart> parts;
  for (const Pair& pair : wrong) {
    const trace::Flaw flaw = hypothesis.part(pair);
    const auto named = [&](const CausePart& part) { return part.flaw.name == flaw.name; };
    const auto known = std::ranges::find_if(parts, named);
    if (known == parts.end()) {
      parts.push_back({flaw, 1});
    } else {
      ++known->count;
    }
  }
  std::ranges::stable_sort(parts, std::ranges::greater{}, &CausePart::count);
  return parts;
}

std::string sentence(const Evidence& evidence, const Hypothesis& hypothesis,
                     std::uint64_t right_with) {
  std::string text =
      fmt::format("all {} {} pairs {}", evidence.wrong.size(), evidence.kind, hypothesis.text);
  if (right_with == 0) return text + fmt::format("; none of the {} does", evidence.right_kind);
  return text +
         fmt::format("; so do {} of {} {}", right_with, evidence.right.size(), evidence.right_kind);
}

}  // namespace

bool may_be_claimed(std::size_t wrong, std::size_t right_with, std::size_t right, double tries) {
  if (static_cast<double>(right_with) > kMostRight * static_cast<double>(right)) return false;
  return log_chance(wrong, right_with, right) < std::log(kMostChance / kHypotheses / tries);
}

std::vector<Pair> spread(std::span<const Pair> pairs, std::size_t most) {
  if (pairs.size() <= most) return {pairs.begin(), pairs.end()};
  std::vector<Pair> chosen;
  for (std::size_t k = 0; k < most; ++k) chosen.push_back(pairs[k * pairs.size() / most]);
  return chosen;
}

std::optional<Cause> common_cause(const Evidence& evidence,
                                  std::span<const Hypothesis> hypotheses) {
  const Hypothesis* best = nullptr;
  std::uint64_t best_right = 0;
  for (const Hypothesis& hypothesis : hypotheses) {
    if (!std::ranges::all_of(evidence.wrong, hypothesis.holds)) continue;
    const auto right_with =
        static_cast<std::uint64_t>(std::ranges::count_if(evidence.right, hypothesis.holds));
    if (best != nullptr && right_with >= best_right) continue;
    if (!hypothesis.spoils_some && right_with * kMostContrary > evidence.wrong.size()) continue;
    if (!may_be_claimed(evidence.wrong.size(), right_with, evidence.right.size(),
                        hypothesis.tries)) {
      continue;
    }
    best = &hypothesis;
    best_right = right_with;
  }
  if (best == nullptr) return std::nullopt;
  Cause cause = {.kind = std::string(evidence.kind),
                 .name = best->name,
                 .text = sentence(evidence, *best, best_right),
                 .wrong = evidence.wrong.size(),
                 .right = evidence.right.size(),
                 .right_with = best_right,
                 .parts = parts_of(*best, evidence.wrong)};
  if (cause.parts.size() == 1) cause.name = cause.parts.front().flaw.name;
  return cause;
}

bool is_too_little(const Evidence& evidence) {
  return !may_be_claimed(evidence.wrong.size(), 0, evidence.right.size(), 1.0);
}

}  // namespace octocell::judge
