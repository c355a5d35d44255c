// SPDX-License-Identifier: MIT
// Stage 6, resolve: decide the uncertain pairs.
// Reads uncertain pairs, spheres. Writes pairs.
// Cost: about 10 ns a pair on one thread. Few pairs in a million are uncertain, but all pairs of a
//       lattice of tangent spheres are. If not all may fit, they are first decided just to count
//       them.
// Idea: float64 with an error bound, error-free transformations, integers: the first that is
//       certain decides. copy_if keeps the pairs that overlap, behind the certain ones.
#include <thrust/copy.h>
#include <thrust/count.h>

#include <cstdint>

#include "impl_thrust/decide.cuh"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {

template <typename System>
void resolve(Workspace<System>& w) {
  if (w.plan.count_only) return;  // stage 5 has already decided them
  if (w.uncertain_count == 0 || !w.uncertain_pairs_complete()) return;
  const Pair* const uncertain_pairs = w.uncertain_pairs.data();
  const Pair* const end = uncertain_pairs + w.uncertain_count;
  const Overlaps overlaps = {w.spheres};
  if (w.sure_count + w.uncertain_count > w.plan.capacity.pairs) {
    w.pair_count += static_cast<std::uint64_t>(
        thrust::count_if(w.system.policy(), uncertain_pairs, end, overlaps));
    if (!w.pairs_complete()) return;
  }
  Pair* const behind = w.pairs.data() + w.sure_count;
  const Pair* const last =
      thrust::copy_if(w.system.policy(), uncertain_pairs, end, behind, overlaps);
  w.pair_count = w.sure_count + static_cast<std::uint64_t>(last - behind);
}

OCTOCELL_FOR_BOTH_SYSTEMS(resolve);

}  // namespace octocell::on_thrust
