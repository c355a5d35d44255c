// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/threads.hpp"

namespace octocell::cpu {

/// Two arrays of equal length that are sorted together.
struct KeysAndValues {
  std::span<std::uint32_t> keys;
  std::span<std::uint32_t> values;
};

struct Sorted {
  int side = 0;  // 0: the result is in `front`, 1: in `back`
  int passes_skipped = 0;
};

/// Of a digit. Two passes of 9 bits take as long as two of 8, where caches of 48 KiB hold a line
/// for each of 512 places that a pass writes to; with 10 bits they take twice as long.
inline constexpr int kWidestDigit = block_size(9, 3);

/// Stable LSD radix sort of (key, value) by the lowest `key_bits` bits of the key, a digit a pass.
/// `front` holds the input; the two buffers are used in turn. All four spans have equal length,
/// below 2^32. With `skip_passes`, a digit that all keys share is not sorted by (Terdiman, Radix
/// Sort Revisited, 2000).
Sorted radix_sort(KeysAndValues front, KeysAndValues back, int key_bits, bool skip_passes,
                  Threads& threads);

}  // namespace octocell::cpu
