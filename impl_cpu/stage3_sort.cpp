// SPDX-License-Identifier: MIT
// Stage 3, sort: bring equal cell ids together.
// Reads and writes cell ids with their objects, grouped by cell, homes before phantoms.
// Cost: 20 bytes per id and pass; ceil(key_bits / 9) passes.
// Idea: sort only by the bits that ids of this grid can have.
#include <cstdint>

#include "impl_cpu/radix_sort.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {
namespace {

KeysAndValues used_part(const IdArrays& ids, std::uint64_t count) {
  return {{ids.cell_ids.data(), count}, {ids.objects.data(), count}};
}

}  // namespace

void sort(Workspace& w) {
  if (w.violation || !w.ids_complete() || w.used.has(Skip::sort)) return;
  w.current =
      radix_sort(used_part(w.ids[0], w.id_count), used_part(w.ids[1], w.id_count), w.plan.key_bits,
                 *w.threads, w.record != nullptr ? &w.record->passes.items : nullptr);
}

}  // namespace octocell::cpu
