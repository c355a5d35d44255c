// SPDX-License-Identifier: MIT
// Stage 6, resolve: decide the doubts.
// Reads doubts, spheres. Writes pairs.
// Cost: about 10 ns a doubt; a few doubts in a million pairs, but all pairs of a tangent lattice.
// Idea: float64 with an error bound, error-free transformations, integers: the first that is
//       certain answers.
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {

void resolve(Workspace& w) {
  constexpr std::uint64_t kDoubtsPerBlock = 4096;
  const std::span<const Pair> doubts = w.doubts.items();
  const std::span<const Sphere> spheres = w.scene.spheres;
  w.threads->for_blocks(doubts.size(), kDoubtsPerBlock,
                        [&](std::uint64_t begin, std::uint64_t end) {
                          PairWriter pairs(w.pairs);
                          for (const Pair& pair : doubts.subspan(begin, end - begin)) {
                            if (overlap_exact(spheres[pair.i], spheres[pair.j])) pairs.push(pair);
                          }
                        });
}

}  // namespace octocell::cpu
