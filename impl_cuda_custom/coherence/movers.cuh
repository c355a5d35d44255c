// SPDX-License-Identifier: MIT
// Few spheres that are not static: movers, among static ones that stand. The last search has left
// all spheres in order; of those, the static ones are where they were, and the movers' old places
// are passed over. Where the movers are now says a table of cells: for each bucket of cell ids a
// chain of movers.
#pragma once

#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom::coherence {

struct Movers {
  static constexpr std::uint32_t kNone = ~0U;
  static constexpr int kNumberBits = 28;  // kMaxSpheres
  static_assert(kMaxSpheres <= std::uint64_t{1} << kNumberBits);

  std::uint32_t room;
  std::uint32_t* ids;    // [room] which spheres they are
  std::uint32_t* cells;  // [room] the id of each one's cell
  std::uint32_t* next;   // [room] in the same bucket; or kNone
  std::uint64_t* heads;  // [mask + 1] the first of a bucket, below the number of the frame
  std::uint32_t mask;
  Level level;  // the only one, and open

  /// So heads need not be cleared: those of other frames are empty. 0: of none.
  [[nodiscard]] __device__ static std::uint64_t stamp_of(std::uint64_t frame) {
    return (frame + 1) << kNumberBits;
  }
  [[nodiscard]] __device__ static std::uint32_t number_in(std::uint64_t head, std::uint64_t stamp) {
    constexpr std::uint64_t kNumber = (std::uint64_t{1} << kNumberBits) - 1;
    return (head & ~kNumber) == stamp ? static_cast<std::uint32_t>(head & kNumber) : kNone;
  }

  /// Mover `m` joins the chain of its bucket.
  __device__ void place(std::uint32_t m, const Sphere& s, std::uint64_t frame) const {
    const std::uint32_t cell = cell_id(level.grid, cell_of(level.grid, s.x, s.y, s.z));
    const std::uint64_t stamp = stamp_of(frame);
    auto* const head = reinterpret_cast<unsigned long long*>(&heads[cell & mask]);
    cells[m] = cell;
    next[m] = number_in(atomicExch(head, stamp | m), stamp);
  }
  [[nodiscard]] __device__ std::uint32_t first_of(std::uint32_t cell, std::uint64_t frame) const {
    return number_in(heads[cell & mask], stamp_of(frame));
  }
};

/// Of no use where the workspace has no room for movers.
inline Movers movers_of(const Workspace& w) {
  std::uint32_t* const words = w.movers.data();
  if (w.mover_room == 0) return {};
  return {.room = w.mover_room,
          .ids = words,
          .cells = words + w.mover_room,
          .next = words + 2 * std::uint64_t{w.mover_room},
          .heads = w.mover_heads.data(),
          .mask = static_cast<std::uint32_t>(std::bit_ceil(4 * std::uint64_t{w.mover_room}) - 1),
          .level = w.plan.levels.level[0]};
}

}  // namespace octocell::cuda_custom::coherence
