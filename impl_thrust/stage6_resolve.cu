// SPDX-License-Identifier: MIT
// Stage 6, resolve: decide the doubts.
// Reads doubts, spheres. Writes pairs.
// Cost: about 10 ns a doubt on one thread; a few doubts in a million pairs, but all pairs of a
//       tangent lattice. Where they may not all fit, they are decided once more, to be counted.
// Idea: float64 with an error bound, error-free transformations, integers: the first that is
//       certain answers; copy_if keeps what it confirms, behind the sure pairs.
#include <thrust/copy.h>
#include <thrust/count.h>

#include <cstdint>

#include "impl_thrust/decide.cuh"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {

template <typename System>
void resolve(Workspace<System>& w) {
  if (w.plan.count_only) return;  // stage 5 decided what it met
  if (w.doubt_count == 0 || !w.doubts_complete()) return;
  const Pair* const doubts = w.doubts.data();
  const Pair* const end = doubts + w.doubt_count;
  const Overlaps overlaps = {w.spheres};
  if (w.sure_count + w.doubt_count > w.plan.capacity.pairs) {
    w.pair_count +=
        static_cast<std::uint64_t>(thrust::count_if(w.system.policy(), doubts, end, overlaps));
    if (!w.pairs_complete()) return;
  }
  Pair* const behind = w.pairs.data() + w.sure_count;
  const Pair* const last = thrust::copy_if(w.system.policy(), doubts, end, behind, overlaps);
  w.pair_count = w.sure_count + static_cast<std::uint64_t>(last - behind);
}

OCTOCELL_FOR_BOTH_SYSTEMS(resolve);

}  // namespace octocell::on_thrust
