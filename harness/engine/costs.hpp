// SPDX-License-Identifier: MIT
// What the planner assumes that each backend's work costs, where it is not the default.
#pragma once

#include "core/planner/planner.hpp"

namespace octocell {

/// Fitted to the times of impl_cuda_custom's kernels on an H100 (gas, dense and poly, a million
/// spheres; home_phantom with cells of 1.5 to 6 radii, half_shell with cells of 1 to 2 diameters).
inline constexpr Costs kDeviceCosts = {.per_id = 0.042,
                                       .per_id_and_pass = 0.018,
                                       .per_candidate = 0.0037,
                                       .per_run = 15e3,  // for more kernels
                                       .per_row = 0.0,
                                       .digit_bits = 10,
                                       .shell = {.per_sphere = 0.09,
                                                 .per_row = 0.0,
                                                 .per_window = 0.004,
                                                 .per_candidate = 0.00075,
                                                 .per_probe = 0.01,
                                                 .per_id = 0.0045,
                                                 .per_pass = 0.006,
                                                 .per_wrapped = 0.05,
                                                 .in_cache = 1.0,
                                                 .near_borders = false,
                                                 .finer_probe = true,
                                                 .sides_per_doubling = 4,
                                                 .most_columns = 1}};

/// impl_thrust is written to be read: a sphere finds the rows of its neighbours by binary search.
/// Its sort always takes four passes, which are included in per_id and per_sphere.
inline constexpr Costs kThrustCosts = {.per_id = 53.0,
                                       .per_id_and_pass = 0.0,
                                       .per_candidate = 0.9,
                                       .per_pair = 1.2,
                                       .per_row = 0.0,
                                       .digit_bits = 8,
                                       .shell = {.per_sphere = 213.0,
                                                 .per_row = 700.0,
                                                 .per_window = 60.0,
                                                 .per_candidate = 2.3,
                                                 .per_probe = 470.0,
                                                 .per_pass = 0.0,
                                                 .in_cache = 1.0,
                                                 .near_borders = false,
                                                 .most_columns = 8}};

/// How many times longer the work of each method takes.
struct Factors {
  double home_phantom;
  double half_shell;
  double brute_force;
};
constexpr Costs times(Costs costs, const Factors& factors) {
  costs.per_id *= factors.home_phantom;
  costs.per_id_and_pass *= factors.home_phantom;
  costs.per_candidate *= factors.home_phantom;
  costs.per_id_of_one *= factors.home_phantom;
  costs.per_run *= factors.home_phantom;
  costs.per_pair *= factors.brute_force;
  costs.per_row *= factors.brute_force;
  ShellCosts& shell = costs.shell;
  for (double* cost : {&shell.per_sphere, &shell.per_row, &shell.per_window, &shell.per_candidate,
                       &shell.per_probe, &shell.per_id, &shell.per_pass, &shell.per_wrapped}) {
    *cost *= factors.half_shell;
  }
  return costs;
}

/// Thrust's kernels take longer than ours, most of all those that search for rows. This was
/// measured on the same machine with a hundred to a million spheres. The sort takes four passes
/// there, too. It also allocates and waits, which brute_force does not. One thread handles all
/// cells that a sphere meets.
constexpr Costs with_kernels_of_thrust(Costs costs) {
  constexpr int kPasses = 4;
  costs.digit_bits = 8;
  costs.per_id += kPasses * costs.per_id_and_pass;
  costs.shell.per_sphere += kPasses * costs.shell.per_pass;
  costs.per_id_and_pass = costs.shell.per_pass = 0.0;
  costs = times(costs, {.home_phantom = 1.56, .half_shell = 3.6, .brute_force = 0.35});
  costs.per_id_of_one = 100.0;
  costs.per_grid = 150e3;
  costs.per_run = -20e3;  // home_phantom does not search for rows
  return costs;
}
inline constexpr Costs kThrustDeviceCosts = with_kernels_of_thrust(kDeviceCosts);

}  // namespace octocell
