// SPDX-License-Identifier: MIT
// Chooses the cells of a plan. Usually they are laid over the box of all centres. If a few centres
// far away would make the cells too coarse, they are laid over a box that holds nearly all.
#include "core/planner/choose_cells.hpp"

#include <fmt/format.h>

#include "core/as_written.hpp"
#include "core/chapter32.hpp"
#include "core/error.hpp"
#include "core/planner/bulk.hpp"

namespace octocell {
namespace {

/// A part of the cost of cells over all centres: a plan must cost less than this to replace them.
constexpr double kPays = 0.75;

/// Throws LimitError unless the rounding of p +- S is small compared with r_max; otherwise the rule
/// is not correct (docs/exactness.md, claim C).
void require_chapter32(const PlanFacts& facts) {
  const double ulp = farthest_ulp(facts, chapter32::extent(facts.r_max));
  if (ulp <= facts.r_max / 2.0) return;
  throw LimitError(fmt::format(
      "rule chapter32 does not hold for this scene: float32 has steps of {} at its far end, more "
      "than half the largest radius ({}), so a sphere may meet three cells on one axis; rule "
      "lowest_cell has no such condition",
      ulp, facts.r_max));
}

Grid choose_grid(const SceneStats& stats, const PlanOptions& options) {
  const float r_max = stats.facts.r_max;
  switch (options.rule) {
    case Rule::lowest_cell:
      if (!options.cell_side) return cheapest_grid(stats, options.costs);
      return make_grid(stats.facts, *options.cell_side, widest_box(stats.facts, r_max));
    case Rule::chapter32:
      if (r_max == 0.0F)
        return cheapest_grid(stats, options.costs);  // no phantoms: any cells will do
      require_chapter32(stats.facts);
      return make_grid(stats.facts, chapter32::cell_side(r_max),
                       widest_box(stats.facts, chapter32::extent(r_max)));
    case Rule::as_written:
      break;
  }
  Grid grid;  // as_written.hpp has its own cells; the sort needs the key width
  grid.key_bits = as_written::kIdBits;
  grid.cell_side = as_written::cell_side(r_max);
  return grid;
}

/// Chooses the cells for the box of the centres.
void lay_cells(Plan& plan, const SceneStats& stats, const PlanOptions& options) {
  if (plan.method == Method::home_phantom) {
    plan.grid = choose_grid(stats, options);
    plan.key_bits = plan.grid.key_bits;
  }
  if (plan.method == Method::tiles) plan.tiles = make_tiles(stats);
  if (plan.method == Method::half_shell || plan.method == Method::tiles) {
    plan.levels = cheapest_levels(stats, options.allowed, options.costs,
                                  options.forced.has(Skip::wide_cells) ? 2 : 1);
    plan.key_bits = key_bits_of(plan.levels);
    const bool may_reuse = plan.moving && !options.count_only;
    if (may_reuse && plan.method == Method::half_shell)
      plan.skin = skin_cells(stats, options.allowed, options.costs);
  }
  if (plan.method != Method::brute_force && !options.allowed.has(Skip::key_bits)) {
    plan.key_bits = plan.skin.key_bits = kIdBits;
  }
}

/// Returns true if any cells are correct. Rule chapter32 needs homes that are not clamped.
bool is_free(const Plan& plan) {
  return plan.method == Method::half_shell || plan.method == Method::tiles ||
         (plan.method == Method::home_phantom && plan.rule == Rule::lowest_cell);
}

}  // namespace

void choose_cells(Plan& plan, const SceneStats& stats, const PlanOptions& options) {
  lay_cells(plan, stats, options);
  if (!is_free(plan)) return;
  for (const Bulk& bulk : stats.bulk) {
    const SceneStats seen = only_bulk(stats, bulk);
    Plan closer = plan;
    lay_cells(closer, seen, options);
    const double cost = estimate_cost(seen, closer, options.costs);
    if (cost < kPays * estimate_cost(seen, plan, options.costs)) plan = closer;
  }
}

}  // namespace octocell
