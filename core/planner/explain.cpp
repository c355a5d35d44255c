// SPDX-License-Identifier: MIT
#include "core/planner/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/digit_plan.hpp"
#include "core/error.hpp"
#include "core/planner/warnings.hpp"

namespace octocell {
namespace {

std::string size_of_box(const float (&lowest)[3], const float (&highest)[3]) {
  const auto extent = [&](int axis) { return static_cast<double>(highest[axis]) - lowest[axis]; };
  return fmt::format("{:g} x {:g} x {:g}", extent(0), extent(1), extent(2));
}

std::string scene_of(const SceneStats& stats) {
  const PlanFacts& f = stats.facts;
  if (f.sphere_count == 0) return "no spheres";
  std::string text = fmt::format("{} spheres, radii {:g} to {:g}, centres in {}", f.sphere_count,
                                 f.r_min, f.r_max, size_of_box(f.lowest, f.highest));
  if (!stats.bulk.empty()) {
    text += ", most of them in " + size_of_box(stats.bulk[0].lowest, stats.bulk[0].highest);
  }
  return text;
}

std::string cells_of(const Grid& g) {
  return fmt::format("{} x {} x {} cells of side {:g}{}", g.cell_count[0], g.cell_count[1],
                     g.cell_count[2], g.cell_side,
                     g.wraps() ? "; far cells share ids, which costs candidates but no pair" : "");
}

std::string levels_of(const Levels& levels) {
  std::string text = "half_shell: one id a sphere, own cell and half of its neighbours";
  for (int k = 0; k < levels.count; ++k) {
    const Level& level = levels.level[k];
    const Grid& g = level.grid;
    text += fmt::format("\n|    level {}: r <= {:g}, {} x {} rows of side {:g}, {} columns each{}",
                        k, level.r_max, g.cell_count[1], g.cell_count[2], g.cell_side,
                        g.cell_count[0], g.wraps() ? "; far cells share ids" : "");
  }
  return text;
}

std::string tiles_of(const Plan& plan) {
  const Tiles& tiles = plan.tiles;
  return fmt::format(
      "tiles: {} x {} x {} of {} x {} x {} cells of side {:g}, each with room for {} spheres and "
      "copies; half_shell if one has more than {}",
      tiles.count[0], tiles.count[1], tiles.count[2], tiles.width[0].units, tiles.width[1].units,
      tiles.width[2].units, tiles.grid.cell_side, plan.capacity.tile_records, kMostTileRecords);
}

std::string method_of(const Plan& plan) {
  if (plan.method == Method::brute_force) return "brute_force: every pair is tested";
  if (plan.method == Method::half_shell) return levels_of(plan.levels);
  if (plan.method == Method::tiles) return tiles_of(plan);
  if (plan.rule == Rule::as_written) {
    return fmt::format(
        "home_phantom, rule as_written: the text's own cells of side {:g} (a "
        "negative control: it loses pairs)",
        plan.grid.cell_side);
  }
  return fmt::format("home_phantom, rule {}: {}", name_of(plan.rule), cells_of(plan.grid));
}

std::string sort_of(const Plan& plan) {
  if (plan.method == Method::brute_force) return "none";
  if (plan.method == Method::tiles) return "by counting, within each tile";
  const int passes = sort_passes(plan.key_bits, plan.sort_digit_bits);
  return fmt::format("radix sort of ids of {} bits, {} pass{} of up to {} bits", plan.key_bits,
                     passes, passes == 1 ? "" : "es", plan.sort_digit_bits);
}

std::string predicate_of(const Plan& plan) {
  if (plan.predicate != Predicate::exact) return std::string(name_of(plan.predicate));
  if (plan.test == PairTest::f32) return "plain float32, exact on this scene's lattice";
  return plan.test == PairTest::filter_safe
             ? "float32 with a filter and guards; uncertain pairs exactly"
             : "float32 with a filter, without guards; uncertain pairs exactly";
}

/// Returns the fact of the scene that speaks for or against a skip.
std::string fact_of(Skip skip, const SceneStats& stats, const Plan& plan, bool taken) {
  const PlanFacts& f = stats.facts;
  switch (skip) {
    case Skip::search:
      return stats.some_may_collide ? "some spheres may collide by their flags"
                                    : "by their flags no two spheres may collide";
    case Skip::grid:
      return fmt::format(
          "{} spheres have {:.3g} pairs", f.sphere_count,
          0.5 * static_cast<double>(f.sphere_count) * (static_cast<double>(f.sphere_count) - 1.0));
    case Skip::phantoms:
      return plan.method != Method::home_phantom ? "cells are a diameter wide or more"
                                                 : "half_shell would cost more, or is not allowed";
    case Skip::wide_cells:
      return fmt::format("radii differ by a factor of {:.3g}{}",
                         f.r_min_nonzero > 0.0F ? f.r_max / f.r_min_nonzero : 1.0F,
                         taken ? "" : ", too little for a second level");
    case Skip::layers:
      return taken ? "an axis has one layer of cells"
                   : "every axis has more than one layer of cells";
    case Skip::key_bits:
      return fmt::format("ids stay below 2^{}", plan.key_bits);
    case Skip::safe_filter:
      return fmt::format("radii lie in [{:g}, {:g}]", f.r_min_nonzero, f.r_max);
    case Skip::equal_radii:
      return f.r_min == f.r_max ? fmt::format("all radii are {:g}", f.r_max)
                                : fmt::format("radii range from {:g} to {:g}", f.r_min, f.r_max);
    case Skip::uncertain_pairs:
      return f.lattice_units_per_length != 0.0
                 ? fmt::format("all numbers are multiples of 2^{}",
                               -std::ilogb(f.lattice_units_per_length))
                 : "the numbers lie on no lattice that is coarse enough";
    case Skip::sort:
      return taken ? "the ids of this scene allow it"
                   : "the ids do not allow it, or were not checked";
    case Skip::unchanged:
    case Skip::few_movers:
    case Skip::skin:
      return plan.moving ? "checked in every frame" : "one frame only";
  }
  return {};
}

/// Returns the part of the time that a skip saves, from a plan of the same scene without it. None
/// if it saves nothing or such a plan is refused.
std::optional<double> saving_of(Skip skip, const SceneStats& stats, const Plan& plan,
                                PlanOptions options) {
  const double cost = estimate_cost(stats, plan, options.costs);
  options = without_skip(options, skip);
  try {
    const double without = estimate_cost(stats, make_plan(stats, options), options.costs);
    if (without > cost) return 1.0 - cost / without;
  } catch (const LimitError&) {
  }
  return std::nullopt;
}

bool can_matter(Skip skip, const Plan& plan) {
  const bool has_ids = plan.method != Method::brute_force && plan.method != Method::tiles;
  if (skip == Skip::sort) return has_ids;
  return is_planned(skip) || plan.moving;
}

std::string percent(double part) { return fmt::format("{:.0f} %", 100.0 * part); }

std::string savings_of(const Decision& d) {
  if (!d.expected_saving && !d.measured_saving) return {};
  std::string text = "|                         saves ";
  if (d.measured_saving) text += percent(*d.measured_saving) + " of the time, measured";
  if (d.expected_saving && d.measured_saving) text += "; ";
  if (d.expected_saving) text += percent(*d.expected_saving) + " expected";
  return text + "\n";
}

std::string branch_of(const Decision& d) {
  const SkipInfo& info = kSkips[static_cast<std::size_t>(d.skip)];
  if (!d.taken) return fmt::format("|-- keeps {:<16}{}\n", info.name, d.fact);
  return fmt::format(
             "|-- SKIPS {:<16}{}\n"
             "|                         because {}; safe, since {}\n",
             info.name, info.saves, d.fact, info.proof) +
         savings_of(d);
}

}  // namespace

PlanOptions without_skip(PlanOptions options, Skip skip) {
  options.allowed = options.allowed.without(skip);
  options.forced = options.forced.without(skip);
  if (skip == Skip::grid || skip == Skip::phantoms) options.method.reset();
  return options;
}

Explanation explain(const SceneStats& stats, const Plan& plan, const PlanOptions& options,
                    std::optional<Skips> used) {
  Explanation e = {.scene = scene_of(stats),
                   .method = method_of(plan),
                   .sort = sort_of(plan),
                   .predicate = predicate_of(plan),
                   .decisions = {},
                   .warnings = {}};
  if (stats.facts.sphere_count == 0) return e;
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    const auto skip = static_cast<Skip>(k);
    if (!can_matter(skip, plan)) continue;
    Decision d;
    d.skip = skip;
    d.taken = plan.taken.has(skip) || (used && used->has(skip));
    d.fact = fact_of(skip, stats, plan, d.taken);
    if (!options.allowed.has(skip)) d.fact = "not allowed";
    if (!options.known.has(skip)) d.fact = "this backend does not have it";
    if (d.taken && is_planned(skip)) d.expected_saving = saving_of(skip, stats, plan, options);
    e.decisions.push_back(d);
  }
  e.warnings = warnings_of(stats, plan, options);
  return e;
}

std::string to_text(const Explanation& e) {
  std::string text = fmt::format("scene      {}\nmethod     {}\nsort       {}\npredicate  {}\n",
                                 e.scene, e.method, e.sort, e.predicate);
  for (const Decision& d : e.decisions) text += branch_of(d);
  for (const std::string& warning : e.warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace octocell
