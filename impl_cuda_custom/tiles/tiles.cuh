// SPDX-License-Identifier: MIT
// Method tiles: spheres are distributed once into tiles, then a block searches each tile in shared
// memory. There is no sort of all spheres and no random read.
#pragma once

#include <cstdint>

#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom::tiles {

/// Throws LimitError if this GPU has too little shared memory for the plan; otherwise makes the
/// kernels' share of it as large as they need.
void prepare(const Workspace& w);

/// Stages 1 and 2: compares the spheres with the plan's facts and puts them into their tiles.
void partition(Workspace& w);

/// Stage 5: sorts each tile's spheres by cell and tests them.
void find_in_tiles(Workspace& w);

/// The kernels' parts of prepare().
void prepare_partition(const Workspace& w, std::uint32_t shared_bytes);
void prepare_find(const Workspace& w, std::uint32_t shared_bytes);

/// Returns the most shared memory that a block may have.
std::uint32_t shared_bytes_of_block();

}  // namespace octocell::cuda_custom::tiles
