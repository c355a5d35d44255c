// SPDX-License-Identifier: MIT
// The ways to run one of our backends: every method, and home_phantom with every rule.
#pragma once

#include "core/plan.hpp"

namespace octocell {

struct Way {
  Method method;
  Rule rule;
};

inline constexpr Way kWays[] = {{Method::home_phantom, Rule::lowest_cell},
                                {Method::home_phantom, Rule::chapter32},
                                {Method::home_phantom, Rule::as_written},
                                {Method::half_shell, Rule::lowest_cell},
                                {Method::brute_force, Rule::lowest_cell}};

}  // namespace octocell
