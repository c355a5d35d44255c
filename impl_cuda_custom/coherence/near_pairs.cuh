// SPDX-License-Identifier: MIT
// Near pairs (Verlet 1967, Computer "experiments" on classical fluids): those that overlap if every
// radius is larger by the growth. As long as no sphere is further than that from where it was in
// the search, pairs that overlap are among them (docs/exactness.md, the skin).
#pragma once

#include "impl_cuda_custom/pair_sinks.cuh"

namespace octocell::cuda_custom::coherence {

/// To be filled by a search.
inline PairList near_list(Workspace& w) {
  if (!w.allowed().near_pairs) return {};
  return {w.near_pairs.data(), w.allowed().near_room, &w.kept.data()->near_pairs};
}

/// Do the spheres overlap as they are, neither grown nor with a band's radius?
__device__ inline Verdict test_in_float32(Band band, const Sphere& a, const Sphere& b) {
  return band == Band::fast ? band_verdict<Band::fast>(a, b) : band_verdict<Band::safe>(a, b);
}

/// Stage 5 of a search of grown spheres: all that it finds are near pairs, which are listed; those
/// that overlap as they are, are pairs (or doubts). A list that is too short holds up nothing.
class KeepNear {
 public:
  static constexpr int kBlocksAtOnce = 4;
  struct Shared {
    PairWriter::Shared near_pairs;
    PairWriter::Shared pairs;
    PairWriter::Shared doubts;
  };
  __device__ KeepNear(const SinkArguments& to, Shared& shared)
      : to_(to),
        near_pairs_(to.near_pairs, shared.near_pairs),
        pairs_(to.pairs, shared.pairs),
        doubts_(to.doubts, shared.doubts) {}

  /// All lanes of the warp call it. Of grown spheres both answers mean the same.
  __device__ void take(Verdict grown, Pair pair) {
    const bool is_near = grown != Verdict::apart && !to_.keeps_apart(pair);
    Verdict verdict = Verdict::apart;
    if (is_near) {
      verdict = test_in_float32(to_.band, load_sphere(to_.spheres, pair.i),
                                load_sphere(to_.spheres, pair.j));
    }
    near_pairs_.push(is_near, pair);
    pairs_.push(verdict == Verdict::overlap, pair);
    doubts_.push(verdict == Verdict::doubt, pair);
  }
  __device__ void close() {
    near_pairs_.close();
    pairs_.close();
    doubts_.close();
  }

 private:
  const SinkArguments& to_;  // a kernel's parameter
  PairWriter near_pairs_;
  PairWriter pairs_;
  PairWriter doubts_;
};

}  // namespace octocell::cuda_custom::coherence
