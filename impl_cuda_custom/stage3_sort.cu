// SPDX-License-Identifier: MIT
// Stage 3, sort: bring equal cell ids together.
// Reads and writes cell ids with their objects, grouped by cell, homes before phantoms.
// Cost: 16 bytes per id and pass, and one more read of the ids; two to four passes. Nothing if the
//       ids are already in order (method half_shell).
// Idea: sort only by the bits that ids of this grid can have, and only as many ids as there are.
//       Their number never leaves the device, nor does the decision whether they must be sorted at
//       all.
#include <vector>

#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom {

void sort(Workspace& w) {
  if (!w.sorter || w.sphere_count() == 0) return;
  std::vector<SortPass>* const passes = w.record != nullptr ? &w.record->passes.items : nullptr;
  if (w.half_shell()) {  // its stage 2 has already counted the digits
    State* const state = w.state.data();
    return w.sorter_now().launch_passes(w.side(0), w.side(1), &state->entries, &state->out_of_order,
                                        w.sort_scratch.data(), w.stream, passes);
  }
  w.sorter->launch(w.side(0), w.side(1), &w.state.data()->entries, w.sort_scratch.data(), w.stream,
                   passes);
}

}  // namespace octocell::cuda_custom
