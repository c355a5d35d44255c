// SPDX-License-Identifier: MIT
// Neighbor pairs (Verlet 1967, Computer "experiments" on classical fluids) are those that overlap
// if every radius is larger by the growth. As long as no sphere is further than that from where it
// was in the search, all pairs that overlap are among them (docs/exactness.md, the skin).
#pragma once

#include "impl_cuda_custom/pair_sinks.cuh"

namespace octocell::cuda_custom::coherence {

/// Returns the list that a search fills.
inline PairList near_list(Workspace& w) {
  if (!w.allowed().neighbor_list) return {};
  return {w.neighbor_list.data(), w.allowed().near_room, &w.history.data()->neighbor_list};
}

/// Tests the spheres with their own radii, neither enlarged nor changed for a filter.
__device__ inline Verdict test_in_float32(Filter filter, const Sphere& a, const Sphere& b) {
  return filter == Filter::fast ? filter_verdict<Filter::fast>(a, b)
                                : filter_verdict<Filter::safe>(a, b);
}

/// Stage 5 of a search of enlarged spheres. Lists all pairs that it finds as neighbor pairs. Those
/// that overlap with their own radii are pairs (or uncertain pairs). The search continues if the
/// list is full.
class KeepNear {
 public:
  static constexpr int kBlocksAtOnce = 4;
  struct Shared {
    PairWriter::Shared neighbor_list;
    PairWriter::Shared pairs;
    PairWriter::Shared uncertain_pairs;
  };
  __device__ KeepNear(const SinkArguments& to, Shared& shared)
      : to_(to),
        neighbor_list_(to.neighbor_list, shared.neighbor_list),
        pairs_(to.pairs, shared.pairs),
        uncertain_pairs_(to.uncertain_pairs, shared.uncertain_pairs) {}

  /// Takes a pair. All lanes of the warp must call it. For enlarged spheres, overlap and uncertain
  /// count alike.
  __device__ void take(Verdict grown, Pair pair) {
    const bool is_near = grown != Verdict::apart && !to_.keeps_apart(pair);
    Verdict verdict = Verdict::apart;
    if (is_near) {
      verdict = test_in_float32(to_.filter, load_sphere(to_.spheres, pair.i),
                                load_sphere(to_.spheres, pair.j));
    }
    neighbor_list_.push(is_near, pair);
    pairs_.push(verdict == Verdict::overlap, pair);
    uncertain_pairs_.push(verdict == Verdict::uncertain, pair);
  }
  __device__ void close() {
    neighbor_list_.close();
    pairs_.close();
    uncertain_pairs_.close();
  }

 private:
  const SinkArguments& to_;  // a kernel's parameter
  PairWriter neighbor_list_;
  PairWriter pairs_;
  PairWriter uncertain_pairs_;
};

}  // namespace octocell::cuda_custom::coherence
