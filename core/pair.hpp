// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/host_device.hpp"
#include "include/octocell/types.hpp"

namespace octocell {

OCTOCELL_HD Pair make_pair_of(std::uint32_t a, std::uint32_t b) {
  return a < b ? Pair{a, b} : Pair{b, a};
}

/// Summarises a set of pairs in 16 bytes: their number, and a sum of mixed pairs that does not
/// depend on their order. A duplicate changes both, so equal digests mean equal multisets (up to a
/// 2^-64 accident).
struct PairDigest {
  std::uint64_t count = 0;
  std::uint64_t checksum = 0;

  constexpr void merge(const PairDigest& other) {
    count += other.count;
    checksum += other.checksum;
  }
  friend constexpr bool operator==(const PairDigest&, const PairDigest&) = default;
};

/// The finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA 2014, fig. 17; constants by Stafford).
OCTOCELL_HD std::uint64_t mix_pair(Pair pair) {
  std::uint64_t z = (std::uint64_t{pair.i} << 32 | pair.j) + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

inline PairDigest digest_of(std::span<const Pair> pairs) {
  PairDigest digest{.count = pairs.size(), .checksum = 0};
  for (const Pair& pair : pairs) digest.checksum += mix_pair(pair);
  return digest;
}

}  // namespace octocell
