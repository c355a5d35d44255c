// SPDX-License-Identifier: MIT
// Method half_shell, where it differs: one id a sphere, spheres gathered once, rows swept.
#pragma once

#include <cstdint>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu::half_shell {

/// Stage 2: the id of each sphere's column.
void cell_ids(Workspace& w);

/// Stage 4: how its blocks of spheres leave room for each other in the list of rows. Each may meet
/// as many rows as it has spheres, or as there are: seldom many, and memory that is not touched
/// need not be cleared.
struct IndexBlocks {
  static constexpr std::uint64_t kSpheres = block_size(1 << 14, 32);
  IndexBlocks(std::uint64_t spheres, const Levels& levels);

  std::uint64_t count;
  std::uint64_t rows_of_each;
};

/// Stage 4: the spheres in the order of their columns, and where each row begins.
void cell_index(Workspace& w);

/// Stage 5: each row against itself and its half shell; each sphere against the finer levels.
void pair_tests(Workspace& w);

/// The same for any ordered spheres of the plan's levels; pairs and uncertain pairs become w's.
/// Returns the number of candidates.
std::uint64_t test_among(Workspace& w, const OrderedSpheres& spheres);

/// Each of `spheres` against each of `others`, which must be few to be quick.
std::uint64_t test_between(Workspace& w, const OrderedSpheres& spheres,
                           const OrderedSpheres& others);

}  // namespace octocell::cpu::half_shell
