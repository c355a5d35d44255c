// SPDX-License-Identifier: MIT
// What a plan is expected to cost. Only the choice between correct plans depends on it, never an
// answer.
#pragma once

#include <cstdint>

#include "core/plan.hpp"
#include "core/planner/scene_stats.hpp"

namespace octocell {

/// Costs of method half_shell, in nanoseconds.
struct ShellCosts {
  double per_sphere = 10.0;     // to make its id, gather it, and search the window in its own row
  double per_row = 290.0;       // to find a row's neighbours, and to list the spheres near them
  double per_window = 2.0;      // of a sphere, in a neighbouring row
  double per_candidate = 0.06;  // in a window
  double per_probe = 80.0;      // of a sphere, in a row of another level
  double per_id = 0.0;  // of a possible id, with or without a sphere; at most 8 ids a sphere count
  double per_pass = 1.4;     // to sort a sphere by one digit
  double per_wrapped = 0.0;  // added for a sphere in a level with a wrapped axis
  double in_cache = 0.7;     // factor on all this for a hundred spheres; 1 for 1e5 spheres and more
  bool near_borders = true;  // a row tests only the spheres near its borders against other rows
  bool finer_probe = false;  // spheres of the finer level search the coarser one
  int sides_per_doubling = 1;       // how many cell sides are tried for each doubling
  std::uint32_t most_columns = 16;  // the most columns that a cell is cut into
};

/// What work costs on the machine that will do it, in nanoseconds; only the ratios matter. The
/// defaults were measured on one CPU (docs/decisions/0004-cell-size.md).
struct Costs {
  double per_id = 20.0;          // to make an id, and to read it in stages 4 and 5
  double per_id_and_pass = 1.5;  // to sort an id by one digit
  double per_candidate = 0.4;
  double per_id_of_one = 0.0;  // for the sphere with the most ids, if one thread makes them all
  double per_grid = 0.0;       // for either method with a grid, in any scene
  double per_run = 0.0;        // for home_phantom, added to per_grid, in any scene
  double per_pair = 0.2;       // for brute_force
  double per_row = 5.0;        // for brute_force: a sphere that is tested against all behind it
  int digit_bits = 9;          // the widest digit of one sorting pass
  ShellCosts shell = {};
};

/// Returns the expected cost of a plan, in the unit of Costs.
double estimate_cost(const SceneStats& stats, const Plan& plan, const Costs& costs);

/// Returns how many nanoseconds half_shell is expected to take with these levels.
double estimate_cost(const SceneStats& stats, const Levels& levels, int key_bits,
                     const Costs& costs);

/// Work that home_phantom with rule lowest_cell is expected to do on a grid.
struct WorkEstimate {
  double ids = 0.0;
  double candidates = 0.0;
  double cost_ns = 0.0;
};
WorkEstimate estimate_work(const SceneStats& stats, const Grid& grid, const Costs& costs = {});

}  // namespace octocell
