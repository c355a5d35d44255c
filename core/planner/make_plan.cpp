// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/planner/choose_cells.hpp"
#include "core/planner/choose_test.hpp"

namespace octocell {
namespace {

/// Positions in the sorted arrays are 32-bit numbers.
constexpr std::uint64_t kMaxIds = 4294967295;

std::uint64_t id_capacity(const SceneStats& stats, const Plan& plan) {
  const double count = static_cast<double>(stats.facts.sphere_count);
  if (plan.rule != Rule::lowest_cell) return 8 * stats.facts.sphere_count;
  const double expected = estimate_work(stats, plan.grid).ids;
  if (expected > static_cast<double>(kMaxIds)) {
    throw LimitError(
        fmt::format("cell side {:g}: the spheres would meet about {:g} cells, and {} "
                    "are the limit; larger cells meet fewer",
                    plan.grid.cell_side, expected, kMaxIds));
  }
  // A quarter more than expected: untouched pages cost nothing, but a second run does.
  const auto room = static_cast<std::uint64_t>(std::max(expected * 1.25, count)) + 64;
  return std::min(room, kMaxIds);
}

/// Returns room for eight pairs a sphere: enough for most scenes, and pages that are not needed
/// stay untouched.
std::uint64_t pair_capacity(std::uint64_t sphere_count, bool count_only) {
  return count_only ? 0 : 8 * sphere_count + 64;
}

Capacities first_capacities(const SceneStats& stats, const Plan& plan) {
  Capacities room;
  if (plan.method == Method::home_phantom) {
    room.ids = id_capacity(stats, plan);
    room.cells = room.ids / 2 + 1;
  }
  if (plan.method == Method::half_shell || plan.method == Method::tiles) {
    room.ids = stats.facts.sphere_count;
    room.cells = stats.facts.sphere_count;  // rows: each holds a sphere
  }
  if (plan.method == Method::tiles) {
    room.tile_records = tile_room(plan.tiles, stats.facts.sphere_count);
  }
  room.pairs = pair_capacity(stats.facts.sphere_count, plan.count_only);
  room.uncertain_pairs = room.pairs;
  return room;
}

void check_options(const PlanOptions& options) {
  if (!options.cell_side) return;
  if (!(*options.cell_side > 0.0) || !std::isfinite(*options.cell_side)) {
    throw InputError(fmt::format("cell side {}: must be positive and finite", *options.cell_side));
  }
  if (options.rule != Rule::lowest_cell) {
    throw InputError(fmt::format("rule {} fixes its own cell side", name_of(options.rule)));
  }
}

/// Adds room on every side: a tenth of the largest extent, or a radius if that is more; around the
/// bulk, a tenth of the bulk's own extent.
SceneStats with_room_to_move(SceneStats stats) {
  PlanFacts& facts = stats.facts;
  float room = facts.r_max;
  for (int a = 0; a < 3; ++a) {
    room = std::max(room, (facts.highest[a] - facts.lowest[a]) / 10.0F);
  }
  for (int a = 0; a < 3; ++a) {
    facts.lowest[a] = std::max(facts.lowest[a] - room, -kFloatMax);
    facts.highest[a] = std::min(facts.highest[a] + room, kFloatMax);
  }
  for (Bulk& bulk : stats.bulk) {
    for (int a = 0; a < 3; ++a) {
      const float more = (bulk.highest[a] - bulk.lowest[a]) / 10.0F;
      bulk.lowest[a] = std::max(bulk.lowest[a] - more, facts.lowest[a]);
      bulk.highest[a] = std::min(bulk.highest[a] + more, facts.highest[a]);
    }
  }
  return stats;
}

bool is_flat(const Plan& plan) {
  return plan.method == Method::half_shell && plan.levels.count > 0 &&
         has_one_layer(plan.levels.level[0].grid);
}

/// Returns the skips that a plan takes.
Skips taken_by(const Plan& plan) {
  Skips taken;
  const auto take_if = [&](bool is_taken, Skip skip) {
    if (is_taken) taken = taken.with(skip);
  };
  take_if(plan.nothing_to_find, Skip::search);
  take_if(plan.method == Method::brute_force, Skip::grid);
  const bool rows = plan.method == Method::half_shell;
  take_if(rows || plan.method == Method::tiles, Skip::phantoms);
  take_if(rows && plan.levels.count > 1, Skip::wide_cells);
  take_if(is_flat(plan), Skip::layers);
  const bool has_ids = plan.method != Method::brute_force && plan.method != Method::tiles &&
                       plan.facts.sphere_count > 0;
  take_if(has_ids && plan.key_bits < kIdBits, Skip::key_bits);
  take_if(plan.test == PairTest::filter_fast || plan.test == PairTest::filter_equal,
          Skip::safe_filter);
  take_if(plan.test == PairTest::filter_equal, Skip::equal_radii);
  take_if(plan.predicate == Predicate::exact && !has_uncertain_pairs(plan.test),
          Skip::uncertain_pairs);
  return taken;
}

Plan plan_method(const SceneStats& stats, Method method, const PlanOptions& options) {
  if (method == Method::tiles && options.predicate != Predicate::exact) {
    throw LimitError(
        fmt::format("method tiles has predicate exact only, not {}", name_of(options.predicate)));
  }
  Plan plan;
  plan.method = method;
  plan.rule = options.rule;
  plan.threads = std::max(options.threads, 1);
  plan.sort_digit_bits = options.costs.digit_bits;
  plan.allowed = options.allowed;
  plan.nothing_to_find = !stats.some_may_collide && options.allowed.has(Skip::search);
  // Other predicates show what one search costs, so nothing is kept from frame to frame.
  plan.moving = options.moving && options.predicate == Predicate::exact;
  plan.count_only = options.count_only;
  plan.candidate_limit = options.candidate_limit;
  plan.predicate = options.predicate;
  plan.test = choose_test(stats, options);
  plan.facts = needed_facts(stats.facts, plan.predicate, plan.test);
  plan.packing = choose_packing(stats.facts, plan.test);
  if (stats.facts.sphere_count > 0) choose_cells(plan, stats, options);
  if (method == Method::tiles && plan.tiles.equal_radii) plan.facts.r_min = stats.facts.r_min;
  plan.taken = taken_by(plan);
  plan.capacity = first_capacities(stats, plan);
  return plan;
}

/// Returns why a plan does not take a skip that the caller forces. Other skips depend on the data.
std::string why_not(const Plan& plan, Skip skip) {
  const Grid& grid = plan.levels.level[0].grid;
  if (skip == Skip::search) return "some spheres may collide by their flags";
  if (plan.method != Method::half_shell && skip < Skip::key_bits) {
    return fmt::format("the method is {}", name_of(plan.method));
  }
  switch (skip) {
    case Skip::layers:
      return fmt::format("the spheres lie in {} x {} x {} cells", grid.cell_count[0],
                         grid.cell_count[1], grid.cell_count[2]);
    case Skip::wide_cells:
      return fmt::format("radii from {:g} to {:g} are all of one octave", plan.facts.r_min_nonzero,
                         plan.facts.r_max);
    case Skip::safe_filter:
      return fmt::format("radii from {:g} to {:g} do not all lie in [2^-60, 2^62]",
                         plan.facts.r_min_nonzero, plan.facts.r_max);
    case Skip::equal_radii:
      return "radii differ, or need guards, or no filter is needed";
    case Skip::uncertain_pairs:
      return "the numbers lie on no lattice that is coarse enough";
    case Skip::key_bits:
      return "the ids need all their bits";
    default:
      return fmt::format("the method is {}", name_of(plan.method));
  }
}

void require_forced(const Plan& plan, const PlanOptions& options) {
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    const auto skip = static_cast<Skip>(k);
    const bool is_known = options.known.has(skip);
    if (!options.forced.has(skip)) continue;
    if (is_known && (!is_planned(skip) || plan.taken.has(skip))) continue;
    throw LimitError(fmt::format("skip {} cannot be forced here: {}", name_of(skip),
                                 is_known ? why_not(plan, skip) : "the backend does not have it"));
  }
}

bool leaves_out(const Plan& plan, Skip skip) {
  if (plan.taken.has(skip)) return true;
  const auto levels = std::span(plan.levels.level, static_cast<std::size_t>(plan.levels.count));
  return skip == Skip::layers &&
         std::ranges::any_of(levels, [](const Level& l) { return has_one_layer(l.grid); });
}

/// Returns a skip that the plan takes although it is forbidden.
std::optional<Skip> disobeyed_by(const Plan& plan) {
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    const auto skip = static_cast<Skip>(k);
    if (!plan.allowed.has(skip) && leaves_out(plan, skip)) return skip;
  }
  return std::nullopt;
}

void require_obeyed(const Plan& plan) {
  const std::optional<Skip> skip = disobeyed_by(plan);
  if (!skip) return;
  throw LimitError(fmt::format(
      "skip {} cannot be forbidden here: {}", name_of(*skip),
      *skip == Skip::layers
          ? fmt::format("float32 has no room for two layers of cells for radii up to {:g}",
                        plan.facts.r_max)
          : fmt::format("the method is {}", name_of(plan.method))));
}

/// Returns the plan with the lowest expected cost among the allowed methods. All methods are exact.
Plan cheapest_plan(const SceneStats& stats, const PlanOptions& options) {
  if (options.forced.has(Skip::grid)) return plan_method(stats, Method::brute_force, options);
  if (options.forced.has(Skip::phantoms)) return plan_method(stats, Method::half_shell, options);
  Plan best = plan_method(stats, Method::home_phantom, options);
  double best_cost = estimate_cost(stats, best, options.costs);
  const auto consider = [&](Method method, Skip skip) {
    if (!options.allowed.has(skip)) return;
    const Plan plan = plan_method(stats, method, options);
    const double cost = estimate_cost(stats, plan, options.costs);
    if (cost >= best_cost || disobeyed_by(plan)) return;
    best = plan;
    best_cost = cost;
  };
  consider(Method::half_shell, Skip::phantoms);
  consider(Method::brute_force, Skip::grid);
  return best;
}

/// Returns the plan for half_shell that a plan for tiles includes.
Plan without_tiles(Plan plan) {
  plan.method = Method::half_shell;
  plan.capacity.tile_records = 0;
  plan.taken = taken_by(plan);
  return plan;
}

}  // namespace

Plan plan_buffers(std::uint64_t sphere_count, const PlanOptions& options) {
  Plan plan;
  plan.threads = 1;
  plan.count_only = options.count_only;
  plan.candidate_limit = options.candidate_limit;
  plan.facts.sphere_count = sphere_count;
  plan.capacity.pairs = pair_capacity(sphere_count, options.count_only);
  return plan;
}

Plan make_plan(const SceneStats& seen, const PlanOptions& options) {
  check_options(options);
  const SceneStats stats = options.moving ? with_room_to_move(seen) : seen;
  const Plan plan =
      options.method ? plan_method(stats, *options.method, options) : cheapest_plan(stats, options);
  require_forced(plan, options);
  require_obeyed(plan);
  return plan;
}

Plan grow(const Plan& plan, const Counts& found) {
  if (found.ids > kMaxIds) {
    throw LimitError(
        fmt::format("the spheres meet {} cells, and {} are the limit", found.ids, kMaxIds));
  }
  const bool tiles_fit = found.tile_records <= kMostTileRecords;
  Plan next = tiles_fit ? plan : without_tiles(plan);
  if (tiles_fit) {
    next.capacity.tile_records = std::max(plan.capacity.tile_records, found.tile_records);
  }
  next.capacity.ids = std::max(plan.capacity.ids, found.ids);
  next.capacity.cells = std::max({plan.capacity.cells, found.cells, next.capacity.ids / 2 + 1});
  if (plan.count_only) return next;
  next.capacity.uncertain_pairs = std::max(plan.capacity.uncertain_pairs, found.uncertain_pairs);
  next.capacity.pairs = std::max(plan.capacity.pairs, found.pairs);
  return next;
}

}  // namespace octocell
