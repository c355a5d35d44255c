// SPDX-License-Identifier: MIT
// Where stage 5 puts the pairs it finds: into the two lists, or only into the sums.
#pragma once

#include <cstdint>

#include "core/flags.hpp"
#include "impl_cuda_custom/exact.cuh"
#include "impl_cuda_custom/pair_writer.cuh"

namespace octocell::cuda_custom {

struct SinkArguments {
  PairList pairs;
  PairList uncertain_pairs;
  const Sphere* spheres;
  const Flags* flags;  // null: every pair may collide
  State* state;
  PairList neighbor_list = {};   // for a search of enlarged spheres, which tests them as they are
  Filter filter = Filter::safe;  // the filter for those tests

  /// Returns true if the flags forbid the pair. Called only for pairs that overlap or may overlap.
  [[nodiscard]] __device__ bool keeps_apart(Pair pair) const {
    return flags != nullptr && !may_collide(flags[pair.i], flags[pair.j]);
  }
};

inline SinkArguments sink_arguments_of(Workspace& w) {
  State* const state = w.state.data();
  return {.pairs = {w.pairs.data(), w.plan.capacity.pairs, &state->pairs},
          .uncertain_pairs = {w.uncertain_pairs.data(), w.plan.capacity.uncertain_pairs,
                              &state->uncertain_pairs},
          .spheres = w.spheres.data(),
          .flags = w.flags_or_none(),
          .state = state};
}

/// Stores pairs, and uncertain pairs for stage 6.
class Keep {
 public:
  /// How many blocks should fit on a multiprocessor: this limits the registers of a thread.
  static constexpr int kBlocksAtOnce = 6;
  struct Shared {
    PairWriter::Shared pairs;
    PairWriter::Shared uncertain_pairs;
  };
  __device__ Keep(const SinkArguments& to, Shared& shared)
      : to_(to),
        pairs_(to.pairs, shared.pairs),
        uncertain_pairs_(to.uncertain_pairs, shared.uncertain_pairs) {}

  /// Stores the pair unless it is apart. All lanes of the warp must call it.
  __device__ void take(Verdict verdict, Pair pair) {
    if (verdict != Verdict::apart && to_.keeps_apart(pair)) verdict = Verdict::apart;
    pairs_.push(verdict == Verdict::overlap, pair);
    uncertain_pairs_.push(verdict == Verdict::uncertain, pair);
  }
  /// Writes what is left. All threads of the block must call it once, at the end.
  __device__ void close() {
    pairs_.close();
    uncertain_pairs_.close();
  }

 private:
  const SinkArguments& to_;  // a kernel's parameter
  PairWriter pairs_;
  PairWriter uncertain_pairs_;
};

/// For a count_only plan, which cannot store uncertain pairs: decides them where they are found.
class Count {
 public:
  static constexpr int kBlocksAtOnce = 3;  // the exact test needs many registers
  struct Shared {};
  __device__ Count(const SinkArguments& to, Shared&) : to_(to) {}

  __device__ void take(Verdict verdict, Pair pair) {
    if (verdict == Verdict::apart || to_.keeps_apart(pair)) return;
    if (verdict == Verdict::uncertain) {
      ++uncertain_pairs_;
      if (!overlap(to_.spheres, pair)) return;
    }
    ++pairs_;
    checksum_ += mix_pair(pair);
  }
  __device__ void close() const {
    add_over_block(&to_.state->pairs, pairs_);
    add_over_block(&to_.state->uncertain_pairs, uncertain_pairs_);
    add_over_block(&to_.state->checksum, checksum_);
  }

 private:
  const SinkArguments to_;
  std::uint64_t pairs_ = 0;
  std::uint64_t uncertain_pairs_ = 0;
  std::uint64_t checksum_ = 0;
};

}  // namespace octocell::cuda_custom
