// SPDX-License-Identifier: MIT
// From what is known of a scene to what to do with it. Pure host code that knows no backend.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/plan.hpp"
#include "core/planner/scene_stats.hpp"

namespace octocell {

/// The same of method half_shell.
struct ShellCosts {
  double per_sphere = 10.0;         // id, gathering, and the window in its own row
  double per_row = 290.0;           // to find its neighbours, and to list what is near them
  double per_window = 2.0;          // of a sphere in a neighbouring row
  double per_candidate = 0.06;      // in a window
  double per_probe = 80.0;          // of a sphere in a row of another level
  double per_id = 0.0;              // that there may be, with or without a sphere; 8 a sphere count
  double per_pass = 1.4;            // of a sphere in the sort, by one digit
  double per_wrapped = 0.0;         // of a sphere in a level with an axis that wraps, besides
  double in_cache = 0.7;            // of all this for a hundred spheres; 1 for 1e5 and more
  bool near_borders = true;         // other rows meet only spheres that are near them
  bool finer_probe = false;         // the finer spheres look for the coarser ones
  int sides_per_doubling = 1;       // that are tried
  std::uint32_t most_columns = 16;  // into which a cell is cut
};

/// What work costs on the machine that will do it, in nanoseconds; only the ratios matter.
/// The defaults are one CPU's (docs/decisions/0004-cell-size.md).
struct Costs {
  double per_id = 20.0;          // to make it, and to look at it in stages 4 and 5
  double per_id_and_pass = 1.5;  // to sort it by one digit
  double per_candidate = 0.4;
  double per_id_of_one = 0.0;  // of the sphere with the most ids, where one thread makes them all
  double per_grid = 0.0;       // of either method with a grid, for any scene
  double per_run = 0.0;        // of home_phantom, beyond half_shell, for any scene
  double per_pair = 0.2;       // of brute_force
  double per_row = 5.0;        // of brute_force: of a sphere, which meets all behind it
  int digit_bits = 9;          // the most that one pass sorts by
  ShellCosts shell = {};
};

/// What a caller may fix; the planner decides the rest.
struct PlanOptions {
  std::optional<Method> method = Method::home_phantom;  // none: the planner chooses
  Rule rule = Rule::lowest_cell;
  Predicate predicate = Predicate::exact;
  int threads = 1;
  bool count_only = false;
  std::uint64_t candidate_limit = ~std::uint64_t{0};
  std::optional<double> cell_side = {};  // scene units; only rule lowest_cell is free to choose
  Skips known = Skips::all();            // that the backend has; the others it is not asked for
  Skips allowed = Skips::all();          // of those
  Skips forced = {};                     // LimitError where the plan cannot take one of them
  bool moving = false;                   // plan for a box a little larger than the spheres fill now
  bool buffers_only = false;             // for baselines, which make their own plans
  Costs costs = {};                      // rule lowest_cell picks the cells that cost least
};

/// What a plan is expected to cost, in the unit of Costs.
double estimate_cost(const SceneStats& stats, const Plan& plan, const Costs& costs);

/// Throws LimitError where the rule's conditions do not hold for this scene or a skip can be
/// neither taken nor left as the options ask, with the reason, and InputError for a cell side that
/// is not a positive finite number.
Plan make_plan(const SceneStats& stats, const PlanOptions& options = {});

/// For a baseline: the sizes of buffers, and nothing that takes a look at the spheres.
Plan plan_buffers(std::uint64_t sphere_count, const PlanOptions& options);

/// The next plan after a full buffer: every capacity at least what was found. Throws LimitError
/// where that is more than positions of 32 bits can count.
Plan grow(const Plan& plan, const Counts& found);

/// The step of float32 at the far end of the scene's boxes p +- extent.
double farthest_ulp(const PlanFacts& facts, float extent);

/// The widest box [p - extent, p + extent] that can occur, its ends rounded to float32.
double widest_box(const PlanFacts& facts, float extent);

/// The finest grid over the box of centres whose cell side is at least `cell_side`, with ids below
/// 2^31. Where a dense numbering would need more, axes wrap; a wrapped axis has a period of at
/// least twice (`widest`, the width of what a sphere may cover, plus two cells), so that no two
/// overlapping spheres meet in a cell that only shares its id with another.
Grid make_grid(const PlanFacts& facts, double cell_side, double widest);

/// The finest grid for half_shell over the box of centres whose cells are at least `cell_side` and
/// two `r_max` wide, cut into at most `columns` columns, with ids below 2^most_bits. Axes wrap as
/// above; 2^most_bits >= 2^27 leaves a wrapped axis a period of 2^8 or more, where four cells and
/// two extents are needed.
Level make_level(const PlanFacts& facts, float r_max, double cell_side, std::uint32_t columns,
                 int most_bits);

/// Whether rows of such cells have none above and below, or none beside them.
inline bool has_one_layer(const Grid& grid) {
  return grid.cell_count[1] == 1 || grid.cell_count[2] == 1;
}

/// The levels with the least expected work for half_shell, which is correct with any. Without skip
/// `layers` an axis along which all spheres lie in one layer gets a second, if float32 has room.
Levels cheapest_levels(const SceneStats& stats, Skips allowed = Skips::all(),
                       const Costs& costs = {}, std::size_t least_levels = 1);

/// For frames that move: cells of half_shell for spheres that have grown by a part of the mean
/// radius. None (growth 0) where radii would leave the range in which growing is exact.
SkinCells skin_cells(const SceneStats& stats, Skips allowed = Skips::all(),
                     const Costs& costs = {});

/// Nanoseconds that half_shell is expected to take with them.
double estimate_cost(const SceneStats& stats, const Levels& levels, int key_bits,
                     const Costs& costs);

/// Every id of the levels is below two to this.
int key_bits_of(const Levels& levels);

inline constexpr int kMaxKeyBits = 31;

/// The usual distance of neighbours: the cube root of the box's volume per sphere; an axis thinner
/// than that does not count.
double mean_spacing(const PlanFacts& facts);

/// Work that home_phantom with rule lowest_cell is expected to do on a grid.
struct WorkEstimate {
  double ids = 0.0;
  double candidates = 0.0;
  double cost_ns = 0.0;
};
WorkEstimate estimate_work(const SceneStats& stats, const Grid& grid, const Costs& costs = {});

/// The grid with the least expected work for rule lowest_cell, which is correct for any cell side.
Grid cheapest_grid(const SceneStats& stats, const Costs& costs = {});

}  // namespace octocell
