// SPDX-License-Identifier: MIT
// Stage 6, resolve: decide the doubts.
// Reads doubts, spheres. Writes pairs.
// Cost: about 10 ns a doubt; a few doubts in a million pairs, but all pairs of a tangent lattice.
// Idea: float64 with an error bound, error-free transformations, integers: the first that is
//       certain answers.
#include "harness/interface/faults.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {

void resolve_block(Workspace& w, std::span<const Pair> doubts) {
  const std::span<const Sphere> spheres = w.scene.spheres;
  PairWriter pairs(w.pairs);
  for (const Pair& pair : doubts) {
    if (OCTOCELL_FAULT(doubts_taken_as_pairs, true,
                       overlap_exact(spheres[pair.i], spheres[pair.j])))
      pairs.push(pair);
  }
}

void resolve(Workspace& w) {
  constexpr std::uint64_t kDoubtsPerBlock = 4096;
  if (w.plan.count_only) return;  // stage 5 had them resolved block by block
  const std::span<const Pair> doubts = w.doubts.items();
  w.threads->for_blocks(
      OCTOCELL_FAULT(doubts_after_first_block_lost,
                     std::min<std::uint64_t>(doubts.size(), kDoubtsPerBlock), doubts.size()),
      kDoubtsPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
        resolve_block(w, doubts.subspan(begin, end - begin));
      });
}

}  // namespace octocell::cpu
