// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/run_record.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/threads.hpp"

namespace octocell::cpu {

/// Two arrays of equal length that are sorted together.
struct KeysAndValues {
  std::span<std::uint32_t> keys;
  std::span<std::uint32_t> values;
};

/// In bits. Two passes of 9 bits take as long as two of 8 if the cache (48 KiB) holds a line for
/// each of the 512 places that a pass writes to. With 10 bits they take twice as long.
inline constexpr int kWidestDigit = block_size(9, 3);

/// Sorts (key, value) by the lowest `key_bits` bits of the key: a stable LSD radix sort, one digit
/// per pass. `front` holds the input; the two buffers are used in turn. All four spans have equal
/// length, below 2^32. Returns where the result is: 0 for `front`, 1 for `back`. `passes`, if it is
/// not null, receives a copy of what each pass counts and writes.
int radix_sort(KeysAndValues front, KeysAndValues back, int key_bits, Threads& threads,
               std::vector<SortPass>* passes = nullptr);

}  // namespace octocell::cpu
