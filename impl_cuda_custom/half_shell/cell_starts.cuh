// SPDX-License-Identifier: MIT
// Where the spheres with an id begin among the sorted ones. There is a start for each id; or, if
// there are many ids, for each 2^shift ids, followed by a short search.
#pragma once

#include <cstdint>

#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom::half_shell {

struct CellStarts {
  const std::uint32_t* cell_ids;  // sorted
  std::uint32_t* starts;
  int shift;

  /// Returns the first place in [begin, end), or `end`, whose id is `id` or above.
  [[nodiscard]] __device__ std::uint32_t search(std::uint32_t begin, std::uint32_t end,
                                                std::uint32_t id) const {
    while (begin < end) {
      const std::uint32_t middle = begin + (end - begin) / 2;
      if (cell_ids[middle] < id) {
        begin = middle + 1;
      } else {
        end = middle;
      }
    }
    return begin;
  }

  /// Searches all places. `id` is at most one above the largest possible id.
  [[nodiscard]] __device__ std::uint32_t place_of(std::uint32_t id) const {
    const std::uint32_t group = id >> shift;
    const std::uint32_t begin = starts[group];
    if (shift == 0 || (id & ((1U << shift) - 1)) == 0) return begin;
    return search(begin, starts[group + 1], id);
  }
};

inline CellStarts starts_of(Workspace& w) {
  return {.cell_ids = w.sorted().keys,
          .starts = w.cell_starts.data(),
          .shift = starts_shape(w.levels(), w.plan.facts.sphere_count).shift};
}

}  // namespace octocell::cuda_custom::half_shell
