// SPDX-License-Identifier: MIT
// Where a thread of stage 5 puts the pairs it finds.
#pragma once

#include <cstdint>
#include <span>

#include "core/flags.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {

/// Stores uncertain pairs for stage 6. In a count_only plan, which stores none, resolves them block
/// by block.
class UncertainSink {
 public:
  explicit UncertainSink(Workspace& w) : w_(w) {}
  void append(std::span<const Pair> uncertain_pairs) {
    if (!w_.plan.count_only) return w_.uncertain_pairs.append(uncertain_pairs);
    w_.uncertain_pairs.count(uncertain_pairs.size());
    resolve_block(w_, uncertain_pairs);
  }

 private:
  Workspace& w_;
};

class PairSink {
 public:
  explicit PairSink(Workspace& w) : PairSink(w, w.scene.flags) {}
  /// `flags` may be empty if the caller has already checked the flags of all pairs.
  PairSink(Workspace& w, std::span<const Flags> flags)
      : flags_(flags),
        packing_(w.plan.packing),
        sure_(w.pairs),
        uncertain_sink_(w),
        uncertain_pairs_(uncertain_sink_) {}

  /// Takes two spheres that may overlap, with stored radii. Returns what became of them.
  template <PairTest test>
  Judgement take(const Sphere& a, std::uint32_t id_a, const Sphere& b, std::uint32_t id_b) {
    if (!flags_.empty() && !may_collide(flags_[id_a], flags_[id_b])) return Judgement::flags;
    const Pair pair = make_pair_of(id_a, id_b);
    const Verdict verdict = verdict_on<test>(a, b, packing_);
    if (verdict == Verdict::overlap) sure_.push(pair);
    if (verdict == Verdict::uncertain) uncertain_pairs_.push(pair);
    return judgement_of(verdict);
  }

 private:
  std::span<const Flags> flags_;
  Packing packing_;
  PairWriter sure_;
  UncertainSink uncertain_sink_;
  ListWriter<Pair, kListBlock, UncertainSink> uncertain_pairs_;
};

}  // namespace octocell::cpu
