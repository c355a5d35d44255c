// SPDX-License-Identifier: MIT
// A caller may fix what the planner would choose. All choices are exact, so a poor one only costs
// time. The warning comes beforehand, because otherwise only waiting would show it.
#include "core/planner/warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace octocell {
namespace {

/// Times the cost of the planner's own plan. Estimates of such different plans may be off by a
/// factor of two, and rule chapter32 on a plain gas costs about five times as much: users may want
/// that.
constexpr double kDear = 8.0;
constexpr double kWorthAWarning = 1e6;  // nanoseconds: a shorter run needs no warning

PlanOptions left_to_planner(PlanOptions options) {
  options.method.reset();
  options.rule = Rule::lowest_cell;
  options.cell_side.reset();
  options.allowed = options.known;
  options.forced = {};
  return options;
}

/// One thing that a caller fixed.
struct OwnChoice {
  std::string what;
  std::string flag;
  PlanOptions alone;  // with everything else left to the planner
};

std::vector<OwnChoice> own_choices(const PlanOptions& options) {
  std::vector<OwnChoice> choices;
  const PlanOptions free = left_to_planner(options);
  const auto add = [&](std::string what, std::string flag, const auto& fix) {
    choices.push_back({std::move(what), std::move(flag), free});
    fix(choices.back().alone);
  };
  const bool has_rule = options.rule != Rule::lowest_cell;
  if (has_rule) {
    add(fmt::format("rule {}", name_of(options.rule)), "--rule", [&](PlanOptions& alone) {
      alone.method = Method::home_phantom;
      alone.rule = options.rule;
    });
  } else if (options.cell_side) {
    add(fmt::format("cell side {:g}", *options.cell_side), "--cell-side", [&](PlanOptions& alone) {
      alone.method = Method::home_phantom;
      alone.cell_side = options.cell_side;
    });
  } else if (options.method) {
    add(fmt::format("method {}", name_of(*options.method)), "--method",
        [&](PlanOptions& alone) { alone.method = options.method; });
  }
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    const auto skip = static_cast<Skip>(k);
    if (options.known.has(skip) && !options.allowed.has(skip)) {
      add(fmt::format("a plan without skip {}", name_of(skip)),
          fmt::format("--no-skip {}", name_of(skip)),
          [&](PlanOptions& alone) { alone.allowed = alone.allowed.without(skip); });
    }
    if (options.forced.has(skip)) {
      add(fmt::format("skip {}, forced,", name_of(skip)), fmt::format("--force {}", name_of(skip)),
          [&](PlanOptions& alone) { alone.forced = alone.forced.with(skip); });
    }
  }
  return choices;
}

/// Returns none if such a plan is refused.
std::optional<double> expected_cost(const SceneStats& stats, const PlanOptions& options) {
  try {
    return estimate_cost(stats, make_plan(stats, options), options.costs);
  } catch (const LimitError&) {
    return std::nullopt;
  }
}

/// Rounds to one digit: more digits would promise too much.
double rounded(double times) {
  const double unit = std::pow(10.0, std::floor(std::log10(times)));
  return std::round(times / unit) * unit;
}

std::string warning(const std::string& what, double times, const Plan& better,
                    const std::string& flags) {
  return fmt::format(
      "{} is expected to cost about {:.0f} times the planner's choice ({}); leave out {} to take "
      "it",
      what, rounded(times), name_of(better.method), flags);
}

}  // namespace

std::vector<std::string> warnings_of(const SceneStats& stats, const Plan& plan,
                                     const PlanOptions& options) {
  const std::vector<OwnChoice> choices = own_choices(options);
  // The cost of the cells of rule as_written is not modelled.
  if (choices.empty() || options.rule == Rule::as_written) return {};
  const Plan better = make_plan(stats, left_to_planner(options));
  const double least = estimate_cost(stats, better, options.costs);
  const auto is_dear = [&](double cost) {
    return cost > kDear * least && cost - least > kWorthAWarning;
  };
  const double cost = estimate_cost(stats, plan, options.costs);
  if (!is_dear(cost)) return {};
  std::vector<std::string> warnings;
  std::vector<std::string> flags;
  for (const OwnChoice& choice : choices) {
    flags.push_back(choice.flag);
    const std::optional<double> alone = expected_cost(stats, choice.alone);
    if (!alone || !is_dear(*alone)) continue;
    warnings.push_back(warning(choice.what, *alone / least, better, choice.flag));
  }
  if (!warnings.empty()) return warnings;
  return {warning("this choice", cost / least, better, fmt::format("{}", fmt::join(flags, ", ")))};
}

}  // namespace octocell
