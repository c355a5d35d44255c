// SPDX-License-Identifier: MIT
#include "harness/bench/sort/sort_check.hpp"

#include <fmt/format.h>

namespace octocell::bench {
namespace {

/// The finaliser of splitmix64: a bijection, so different pairs give different numbers.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

std::uint64_t pairs_checksum(std::span<const std::uint32_t> keys,
                             std::span<const std::uint32_t> values) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    sum += mix(std::uint64_t{keys[i]} << 32 | values[i]);
  }
  return sum;
}

std::optional<std::string> fault_of(std::span<const std::uint32_t> keys,
                                    std::span<const std::uint32_t> values, const SortTruth& truth,
                                    bool stable) {
  if (keys.size() != truth.size || values.size() != truth.size) {
    return fmt::format("{} keys and {} values instead of {}", keys.size(), values.size(),
                       truth.size);
  }
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i - 1] > keys[i]) {
      return fmt::format("not sorted: key {} at {} comes after {}", keys[i], i, keys[i - 1]);
    }
    if (stable && keys[i - 1] == keys[i] && values[i - 1] > values[i]) {
      return fmt::format("not stable: values {} and {} of key {} changed places at {}",
                         values[i - 1], values[i], keys[i], i);
    }
  }
  if (pairs_checksum(keys, values) != truth.checksum) {
    return "not a permutation: the pairs are not those of the input";
  }
  return std::nullopt;
}

}  // namespace octocell::bench
