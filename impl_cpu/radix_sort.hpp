// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "impl_cpu/threads.hpp"

namespace octocell::cpu {

/// Two arrays of equal length that are sorted together.
struct KeysAndValues {
  std::span<std::uint32_t> keys;
  std::span<std::uint32_t> values;
};

/// Stable LSD radix sort of (key, value) by the lowest `key_bits` bits of the key, 8 bits a pass.
/// `front` holds the input; the two buffers are used in turn. All four spans have equal length,
/// below 2^32. Returns 0 if the result is in `front`, 1 if it is in `back`.
int radix_sort(KeysAndValues front, KeysAndValues back, int key_bits, Threads& threads);

}  // namespace octocell::cpu
