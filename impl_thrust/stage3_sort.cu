// SPDX-License-Identifier: MIT
// Stage 3, sort: bring equal cell ids together.
// Reads and writes cell ids with their objects, grouped by cell, homes before phantoms.
// Cost: all 32 bits of the key, whatever the grid uses; Thrust does not accept a number of bits.
// Idea: stable_sort_by_key, because only stability keeps homes first, and sort_by_key does not
//       promise it. Ids of half_shell may already be in order (a scene stored row by row):
//       is_sorted proves it.
#include <thrust/sort.h>

#include <cstdint>

#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {

template <typename System>
void sort(Workspace<System>& w) {
  if (w.violation || !w.ids_complete()) return;
  std::uint32_t* const keys = w.cell_ids.data();
  const bool may_be_sorted = w.half_shell() && w.plan.allowed.has(Skip::sort);
  if (may_be_sorted && thrust::is_sorted(w.system.policy(), keys, keys + w.id_count)) {
    w.used = w.used.with(Skip::sort);
    return;
  }
  thrust::stable_sort_by_key(w.system.policy(), keys, keys + w.id_count, w.objects.data());
}

OCTOCELL_FOR_BOTH_SYSTEMS(sort);

}  // namespace octocell::on_thrust
