// SPDX-License-Identifier: MIT
// Stage 6, resolve: decide the doubts.
// Reads doubts, spheres. Writes pairs.
// Cost: about 10 ns a doubt on one thread; a few doubts in a million pairs, but all pairs of a
//       tangent lattice. Where they may not all fit, they are decided once more, to be counted.
// Idea: float64 with an error bound, error-free transformations, integers: the first that is
//       certain answers; copy_if keeps what it confirms, behind the sure pairs.
#include <thrust/copy.h>
#include <thrust/transform_reduce.h>

#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {
namespace {

/// Kept out of line: CUDA's algorithms unroll their loops, and this is long (minutes of nvcc).
__attribute__((noinline)) OCTOCELL_HD bool overlap(const Sphere& a, const Sphere& b) {
  return overlap_exact(a, b);
}

struct Overlaps {
  const Sphere* spheres;
  OCTOCELL_HD bool operator()(Pair pair) const { return overlap(spheres[pair.i], spheres[pair.j]); }
};

struct Confirmed {
  std::uint64_t count;
  std::uint64_t checksum;
};
struct Confirm {
  Overlaps overlaps;
  OCTOCELL_HD Confirmed operator()(Pair pair) const {
    if (!overlaps(pair)) return {0, 0};
    return {1, mix_pair(pair)};
  }
};
struct ConfirmedInBoth {
  OCTOCELL_HD Confirmed operator()(const Confirmed& a, const Confirmed& b) const {
    return {a.count + b.count, a.checksum + b.checksum};
  }
};

}  // namespace

template <typename System>
void resolve(Workspace<System>& w) {
  if (w.doubt_count == 0 || !w.doubts_complete()) return;
  const Pair* const doubts = w.doubts.data();
  const Pair* const end = doubts + w.doubt_count;
  const Overlaps overlaps = {w.spheres};
  Pair* const behind = w.pairs.data() + w.sure_count;
  if (!w.plan.count_only && w.sure_count + w.doubt_count <= w.plan.capacity.pairs) {
    const Pair* const last = thrust::copy_if(w.system.policy(), doubts, end, behind, overlaps);
    w.pair_count = w.sure_count + static_cast<std::uint64_t>(last - behind);
    return;
  }
  const Confirmed confirmed = thrust::transform_reduce(
      w.system.policy(), doubts, end, Confirm{overlaps}, Confirmed{0, 0}, ConfirmedInBoth{});
  w.pair_count = w.sure_count + confirmed.count;
  w.checksum += confirmed.checksum;
  if (w.plan.count_only || !w.pairs_complete()) return;
  thrust::copy_if(w.system.policy(), doubts, end, behind, overlaps);
}

OCTOCELL_FOR_BOTH_SYSTEMS(resolve);

}  // namespace octocell::on_thrust
