// SPDX-License-Identifier: MIT
// Sizes of blocks and lists. No answer depends on them.
//
// Faults hide at the borders between blocks, but scenes small enough to be tested by the thousand
// fit into one block. So tests use a second build of impl_cpu in which all these numbers are small
// (octocell_cpu_small, with OCTOCELL_SMALL_BLOCKS).
//
// Prefetch distances do not change, because they reach past the end of small lists anyway. Nor does
// the size of the motion sample, which decides what is tried, not how.
#pragma once

namespace octocell::cpu {

#ifdef OCTOCELL_SMALL_BLOCKS
inline constexpr bool kSmallBlocks = true;
#else
inline constexpr bool kSmallBlocks = false;
#endif

/// Returns `usual`, or `small` in the build with small blocks.
template <typename Number>
constexpr Number block_size(Number usual, Number small) {
  return kSmallBlocks ? small : usual;
}

}  // namespace octocell::cpu
