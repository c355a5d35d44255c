// SPDX-License-Identifier: MIT
// Stage 6, resolve: decide the uncertain pairs.
// Reads uncertain pairs, spheres. Writes pairs.
// Cost: about 10 ns per uncertain pair. Few pairs in a million are uncertain, but all pairs of a
//       lattice of tangent spheres are.
// Idea: float64 with an error bound, error-free transformations, integers: the first that is
//       certain decides.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/lanes.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {
namespace {

constexpr std::size_t kPrefetchAhead = 16;
constexpr std::uint32_t kAtOnce = block_size(8, 4);
using Reals = Vector<double, kAtOnce>;

/// Spheres of several pairs, one array per field.
struct Abreast {
  float x[kAtOnce] = {};
  float y[kAtOnce] = {};
  float z[kAtOnce] = {};
  float r[kAtOnce] = {};
  void put(std::size_t k, const Sphere& s) {
    x[k] = s.x;
    y[k] = s.y;
    z[k] = s.z;
    r[k] = s.r;
  }
};

/// Level 2 for several uncertain pairs at once: the pairs that overlap, and those still uncertain.
struct Verdicts {
  LaneBits overlap;
  LaneBits uncertain;
};
Verdicts float64_verdicts(const Abreast& a, const Abreast& b) {
  const auto reals = [](const float* from) { return Reals(from, stdx::element_aligned); };
  const exact::Float64Test<Reals> test(reals(a.x), reals(a.y), reals(a.z), reals(a.r), reals(b.x),
                                       reals(b.y), reals(b.z), reals(b.r));
  const auto certain = bits_of(abs(test.excess) > test.bound);
  const auto exact = bits_of(test.rounding == 0.0);
  return {.overlap = bits_of(test.excess <= 0.0),
          .uncertain = static_cast<LaneBits>(~(certain | exact))};
}

}  // namespace

void resolve_block(Workspace& w, std::span<const Pair> uncertain_pairs) {
  const std::span<const Sphere> spheres = w.scene.spheres;
  PairWriter pairs(w.pairs);
  for (std::size_t begin = 0; begin < uncertain_pairs.size(); begin += kAtOnce) {
    const std::size_t count = std::min<std::size_t>(kAtOnce, uncertain_pairs.size() - begin);
    Abreast a;
    Abreast b;
    for (std::size_t k = 0; k < count; ++k) {
      const Pair& ahead =
          uncertain_pairs[std::min(begin + k + kPrefetchAhead, uncertain_pairs.size() - 1)];
      __builtin_prefetch(&spheres[ahead.i]);
      __builtin_prefetch(&spheres[ahead.j]);
      a.put(k, spheres[uncertain_pairs[begin + k].i]);
      b.put(k, spheres[uncertain_pairs[begin + k].j]);
    }
    Verdicts verdicts = float64_verdicts(a, b);
    const LaneBits present = first_bits(static_cast<std::uint32_t>(count));
    for_each_lane(verdicts.uncertain & present, [&](std::uint32_t k) {
      const Pair& pair = uncertain_pairs[begin + k];
      const auto bit = static_cast<LaneBits>(1U << k);
      verdicts.overlap &= static_cast<LaneBits>(~bit);
      if (exact::integer_test(spheres[pair.i], spheres[pair.j])) verdicts.overlap |= bit;
    });
    for_each_lane(verdicts.overlap & present,
                  [&](std::uint32_t k) { pairs.push(uncertain_pairs[begin + k]); });
  }
}

void resolve(Workspace& w) {
  constexpr std::uint64_t kUncertainPerBlock = block_size(4096, 8);
  if (w.plan.count_only) return;  // stage 5 has resolved them block by block
  const std::span<const Pair> uncertain_pairs = w.uncertain_pairs.items();
  w.threads->for_blocks(uncertain_pairs.size(), kUncertainPerBlock,
                        [&](std::uint64_t begin, std::uint64_t end) {
                          resolve_block(w, uncertain_pairs.subspan(begin, end - begin));
                        });
}

}  // namespace octocell::cpu
