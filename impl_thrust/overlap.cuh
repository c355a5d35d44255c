// SPDX-License-Identifier: MIT
// Doubts, decided: stage 6 does it for those that were kept, stage 5 where none may be.
#pragma once

#include "harness/interface/pair.hpp"
#include "harness/interface/predicate.hpp"

namespace octocell::on_thrust {

/// Kept out of line: CUDA's algorithms unroll their loops, and this is long (minutes of nvcc).
__attribute__((noinline)) OCTOCELL_HD bool overlap(const Sphere& a, const Sphere& b) {
  return overlap_exact(a, b);
}

/// Pairs that are counted, not kept.
struct Confirmed {
  std::uint64_t count;
  std::uint64_t checksum;

  OCTOCELL_HD void add(Pair pair) {
    ++count;
    checksum += mix_pair(pair);
  }
};
struct ConfirmedInBoth {
  OCTOCELL_HD Confirmed operator()(const Confirmed& a, const Confirmed& b) const {
    return {a.count + b.count, a.checksum + b.checksum};
  }
};

}  // namespace octocell::on_thrust
