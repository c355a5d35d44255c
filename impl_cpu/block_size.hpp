// SPDX-License-Identifier: MIT
// How many things are dealt with at once, and how many a list holds. No answer depends on it.
//
// Borders between blocks are where faults hide, and scenes that are small enough to be tested by
// the thousand meet none of them. So there is a second build of impl_cpu, for tests alone, in which
// all these numbers are small (octocell_cpu_small, with OCTOCELL_SMALL_BLOCKS).
//
// Prefetch distances are not among them, as they reach past the end of small lists in any case; nor
// is the size of the sample of the motion, which decides what is tried and not how.
#pragma once

namespace octocell::cpu {

#ifdef OCTOCELL_SMALL_BLOCKS
inline constexpr bool kSmallBlocks = true;
#else
inline constexpr bool kSmallBlocks = false;
#endif

/// Returns `usual`, but `small` in the build whose blocks are small.
template <typename Number>
constexpr Number block_size(Number usual, Number small) {
  return kSmallBlocks ? small : usual;
}

}  // namespace octocell::cpu
