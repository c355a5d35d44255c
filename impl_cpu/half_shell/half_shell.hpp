// SPDX-License-Identifier: MIT
// The stages of method half_shell that differ: one id a sphere, spheres gathered once, rows swept.
#pragma once

#include <cstdint>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu::half_shell {

/// Stage 2: writes the id of each sphere's column.
void cell_ids(Workspace& w);

/// Divides the list of rows among the blocks of spheres in stage 4. A block may meet as many rows
/// as it has spheres, or as there are rows. Most meet few, and memory that is never touched costs
/// nothing.
struct IndexBlocks {
  static constexpr std::uint64_t kSpheres = block_size(1 << 14, 32);
  IndexBlocks(std::uint64_t spheres, const Levels& levels);

  std::uint64_t count;
  std::uint64_t rows_of_each;
};

/// Stage 4: writes the spheres in the order of their columns, and where each row begins.
void cell_index(Workspace& w);

/// Stage 5: tests each row against itself and its half shell, and each sphere against finer levels.
void pair_tests(Workspace& w);

/// Does the same for any ordered spheres of the plan's levels; stores pairs and uncertain pairs in
/// w. Returns the number of candidates.
std::uint64_t test_among(Workspace& w, const OrderedSpheres& spheres);

/// Tests each of `spheres` against each of `others`; it is fast only if `others` are few.
std::uint64_t test_between(Workspace& w, const OrderedSpheres& spheres,
                           const OrderedSpheres& others);

}  // namespace octocell::cpu::half_shell
