// SPDX-License-Identifier: MIT
// The stages of method half_shell that differ: one id a sphere; partners are searched in adjacent
// cells.
#pragma once

#include <cstdint>

#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust::half_shell {

/// Stage 2: writes the id of each sphere's column.
template <typename System>
void cell_ids(Workspace<System>& w);

/// Stage 4: writes the spheres in the order of their columns and where each row begins; counts
/// candidates.
template <typename System>
void cell_index(Workspace<System>& w);

/// Stage 5: tests each sphere against its half shell, and against the coarser levels around it.
template <typename System>
void pair_tests(Workspace<System>& w);

/// Returns the level that an id belongs to.
OCTOCELL_HD int level_of_id(const Levels& levels, std::uint32_t id) {
  int level = 0;
  while (level + 1 < levels.count && id >= levels.level[level + 1].first_id) ++level;
  return level;
}

/// Returns the first place in [begin, end) where is_before(place) is false; it must stay false from
/// there on.
template <typename IsBefore>
OCTOCELL_HD std::uint32_t first_not(std::uint32_t begin, std::uint32_t end, IsBefore is_before) {
  while (begin < end) {
    const std::uint32_t middle = begin + (end - begin) / 2;
    if (is_before(middle)) {
      begin = middle + 1;
    } else {
      end = middle;
    }
  }
  return begin;
}

}  // namespace octocell::on_thrust::half_shell
