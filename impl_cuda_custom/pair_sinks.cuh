// SPDX-License-Identifier: MIT
// Where stage 5 leaves what it finds: in the two lists, or only in the sums.
#pragma once

#include <cstdint>

#include "core/faults.hpp"
#include "core/flags.hpp"
#include "impl_cuda_custom/exact.cuh"
#include "impl_cuda_custom/pair_writer.cuh"

namespace octocell::cuda_custom {

struct SinkArguments {
  PairList pairs;
  PairList doubts;
  const Sphere* spheres;
  const Flags* flags;  // none: every pair may collide
  State* state;
  PairList near_pairs = {};  // of a search of grown spheres, which tests them as they are
  Band band = Band::safe;    // in this band

  /// Asked for pairs that were found only.
  [[nodiscard]] __device__ bool keeps_apart(Pair pair) const {
    return flags != nullptr && !may_collide(flags[pair.i], flags[pair.j]);
  }
};

inline SinkArguments sink_arguments_of(Workspace& w) {
  State* const state = w.state.data();
  return {.pairs = {w.pairs.data(), w.plan.capacity.pairs, &state->pairs},
          .doubts = {w.doubts.data(), w.plan.capacity.doubts,
                     OCTOCELL_FAULT(cuda_doubts_in_pairs_counter, &state->pairs, &state->doubts)},
          .spheres = w.spheres.data(),
          .flags = w.flags_or_none(),
          .state = state};
}

/// Pairs are kept; doubts, too, for stage 6.
class Keep {
 public:
  /// Blocks that a multiprocessor should have room for: bounds the registers of a thread.
  static constexpr int kBlocksAtOnce = 6;
  struct Shared {
    PairWriter::Shared pairs;
    PairWriter::Shared doubts;
  };
  __device__ Keep(const SinkArguments& to, Shared& shared)
      : to_(to), pairs_(to.pairs, shared.pairs), doubts_(to.doubts, shared.doubts) {}

  /// All lanes of the warp call it.
  __device__ void take(Verdict verdict, Pair pair) {
    if (verdict != Verdict::apart && to_.keeps_apart(pair)) verdict = Verdict::apart;
    pairs_.push(verdict == Verdict::overlap, pair);
    doubts_.push(verdict == Verdict::doubt, pair);
  }
  /// All threads of the block call it, once, at the end.
  __device__ void close() {
    pairs_.close();
    doubts_.close();
  }

 private:
  const SinkArguments& to_;  // a kernel's parameter
  PairWriter pairs_;
  PairWriter doubts_;
};

/// A count_only plan has no room for doubts: they are decided where they are found.
class Count {
 public:
  static constexpr int kBlocksAtOnce = 3;  // the exact test needs many registers
  struct Shared {};
  __device__ Count(const SinkArguments& to, Shared&) : to_(to) {}

  __device__ void take(Verdict verdict, Pair pair) {
    if (verdict == Verdict::apart || to_.keeps_apart(pair)) return;
    if (verdict == Verdict::doubt) {
      ++doubts_;
      if (!overlap(to_.spheres, pair)) return;
    }
    ++pairs_;
    checksum_ += mix_pair(pair);
  }
  __device__ void close() const {
    add_over_block(&to_.state->pairs, pairs_);
    add_over_block(&to_.state->doubts, doubts_);
    add_over_block(&to_.state->checksum, checksum_);
  }

 private:
  const SinkArguments to_;
  std::uint64_t pairs_ = 0;
  std::uint64_t doubts_ = 0;
  std::uint64_t checksum_ = 0;
};

}  // namespace octocell::cuda_custom
