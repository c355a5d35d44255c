// SPDX-License-Identifier: MIT
// Method half_shell, where it differs: one id a sphere, spheres gathered once, rows swept.
#pragma once

#include "impl_cpu/stages.hpp"

namespace octocell::cpu::half_shell {

/// Stage 2: the id of each sphere's column.
void cell_ids(Workspace& w);

/// Stage 4 works on blocks of so many.
inline constexpr std::uint64_t kIndexedPerBlock = 1 << 14;

/// Stage 4: the spheres in the order of their columns, and where each row begins.
void cell_index(Workspace& w);

/// Stage 5: each row against itself and its half shell; each sphere against the finer levels.
void pair_tests(Workspace& w);

/// The same for any ordered spheres of the plan's levels; pairs and doubts become w's. Returns the
/// number of candidates.
std::uint64_t test_among(Workspace& w, const OrderedSpheres& spheres);

/// Each of `spheres` against each of `others`, which must be few to be quick.
std::uint64_t test_between(Workspace& w, const OrderedSpheres& spheres,
                           const OrderedSpheres& others);

}  // namespace octocell::cpu::half_shell
