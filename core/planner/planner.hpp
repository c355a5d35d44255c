// SPDX-License-Identifier: MIT
// From what is known of a scene to what to do with it. Pure host code without knowledge of
// backends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/plan.hpp"
#include "core/planner/cost_model.hpp"
#include "core/planner/scene_stats.hpp"

namespace octocell {

/// What a caller may fix; the planner decides the rest.
struct PlanOptions {
  std::optional<Method> method = Method::home_phantom;  // none: the planner chooses
  Rule rule = Rule::lowest_cell;
  Predicate predicate = Predicate::exact;
  int threads = 1;
  bool count_only = false;
  std::uint64_t candidate_limit = ~std::uint64_t{0};
  std::optional<double> cell_side = {};  // scene units; only rule lowest_cell leaves it free
  Skips known = Skips::all();            // that the backend has; it is never asked for others
  Skips allowed = Skips::all();          // a subset of `known`
  Skips forced = {};          // make_plan() throws LimitError if the plan cannot take one of these
  bool moving = false;        // plans for a box a little larger than the spheres fill now
  bool buffers_only = false;  // for baselines, which need no other plan
  Costs costs = {};           // rule lowest_cell chooses the cheapest cells
};

/// Throws LimitError with the reason if the rule's conditions do not hold for this scene, or if a
/// skip can be neither taken nor left out as the options demand. Throws InputError for a cell side
/// that is not a positive finite number.
Plan make_plan(const SceneStats& stats, const PlanOptions& options = {});

/// Returns a plan for a baseline: only buffer sizes. Does not read the spheres.
Plan plan_buffers(std::uint64_t sphere_count, const PlanOptions& options);

/// Returns the next plan after a buffer was full: every capacity is at least what was found. Throws
/// LimitError if 32-bit positions cannot count that many.
Plan grow(const Plan& plan, const Counts& found);

/// Returns the step of float32 at the far end of the scene's boxes p +- extent.
double farthest_ulp(const PlanFacts& facts, float extent);

/// Returns the width of the widest box [p - extent, p + extent] whose ends are rounded to float32.
double widest_box(const PlanFacts& facts, float extent);

/// Returns the finest grid over the box of centres whose cell side is at least `cell_side`, with
/// ids below 2^31. If numbering all cells would need more, axes wrap. The period of a wrapped axis
/// is at least twice (`widest`, the width of the box of a sphere, plus two cells). So two
/// overlapping spheres never meet under an id that stands for different cells.
Grid make_grid(const PlanFacts& facts, double cell_side, double widest);

/// Returns the finest grid for half_shell over the box of centres. Its cells are at least
/// `cell_side` and two `r_max` wide and are cut into at most `columns` columns; ids are below
/// 2^most_bits. Axes wrap as above. 2^most_bits >= 2^27 leaves a wrapped axis a period of 2^8 or
/// more; four cells and two extents are needed.
Level make_level(const PlanFacts& facts, float r_max, double cell_side, std::uint32_t columns,
                 int most_bits);

/// Returns tiles for method tiles, whose cells are at least two `r_max` wide. Correct for any
/// scene; but if spheres are crowded, a tile may turn out to have more than a thread block can
/// hold.
Tiles make_tiles(const SceneStats& stats);

/// Returns how many spheres and copies a tile should have room for, if they are spread evenly.
std::uint32_t tile_room(const Tiles& tiles, std::uint64_t spheres);

/// Returns the constants for a division by `units`, which is exact below 2^30.
CellWidth cell_width(std::uint32_t units);

/// Returns true if rows of such cells have no rows above and below, or none beside them.
inline bool has_one_layer(const Grid& grid) {
  return grid.cell_count[1] == 1 || grid.cell_count[2] == 1;
}

/// Returns the levels with the least expected work for half_shell, which is correct with any.
/// Without skip `layers`, an axis with a single layer of spheres gets a second layer, if float32
/// has room.
Levels cheapest_levels(const SceneStats& stats, Skips allowed = Skips::all(),
                       const Costs& costs = {}, std::size_t least_levels = 1);

/// For frames that move: returns half_shell cells for spheres enlarged by a part of the mean
/// radius. Returns none (growth 0) if the radii would leave the range in which enlarging is exact.
SkinCells skin_cells(const SceneStats& stats, Skips allowed = Skips::all(),
                     const Costs& costs = {});

/// Returns the number of bits that hold every id of the levels.
int key_bits_of(const Levels& levels);

inline constexpr int kMaxKeyBits = 31;

/// Returns the typical distance of neighbours: the cube root of the box's volume per sphere. An
/// axis thinner than that does not count.
double mean_spacing(const PlanFacts& facts);

/// Returns the grid with the least expected work for rule lowest_cell, which is correct for any
/// cell side.
Grid cheapest_grid(const SceneStats& stats, const Costs& costs = {});

}  // namespace octocell
