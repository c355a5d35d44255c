// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "harness/planner/planner.hpp"

namespace octocell {
namespace {

std::string explain_grid(const Plan& plan) {
  const Grid& g = plan.grid;
  if (plan.rule == Rule::as_written) {
    return fmt::format(
        "cells: side {:g}, the text's own hash of 32 bits (an exhibit: loses pairs)\n",
        g.cell_side);
  }
  std::string line =
      fmt::format("cells: side {:g}, {} x {} x {} over the box of the centres, ids of {} bits",
                  g.cell_side, g.cell_count[0], g.cell_count[1], g.cell_count[2], g.key_bits);
  if (g.wraps()) line += "; far cells share ids, which costs candidates but no pair";
  return line + "\n";
}

}  // namespace

std::string explain(const Plan& plan) {
  std::string text = fmt::format("spheres: {}, radii {:g} to {:g}\n", plan.facts.sphere_count,
                                 plan.facts.r_min_nonzero, plan.facts.r_max);
  if (plan.nothing_to_find) {
    return text + "search: none; by their flags no two spheres may collide\n";
  }
  if (plan.method == Method::brute_force) {
    text += "method: brute_force, every pair is tested\n";
  } else {
    text += fmt::format("method: home_phantom, rule {}\n", name_of(plan.rule));
    text += explain_grid(plan);
    text += fmt::format("sort: {} passes over {} bits\n",
                        sort_passes(plan.grid.key_bits, plan.sort_digit_bits), plan.grid.key_bits);
  }
  text += plan.band == Band::fast
              ? "predicate: fast band (every nonzero radius lies in [2^-60, 2^62])\n"
              : "predicate: safe band (a radius lies outside [2^-60, 2^62])\n";
  text += fmt::format("threads: {}\n", plan.threads);
  return text;
}

}  // namespace octocell
