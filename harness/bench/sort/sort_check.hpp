// SPDX-License-Identifier: MIT
// Checks, without sorting, whether an answer is right.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace octocell::bench {

/// Returns a sum over the (key, value) pairs that does not depend on their order.
std::uint64_t pairs_checksum(std::span<const std::uint32_t> keys,
                             std::span<const std::uint32_t> values);

/// What is known about the right answer. The input's values are 0, 1, 2, ..., so equal keys have
/// kept their order if their values ascend.
struct SortTruth {
  std::size_t size = 0;
  std::uint64_t checksum = 0;
};

/// Returns in one line what is wrong first; none if nothing is. If `stable`, equal keys must have
/// kept their order.
std::optional<std::string> fault_of(std::span<const std::uint32_t> keys,
                                    std::span<const std::uint32_t> values, const SortTruth& truth,
                                    bool stable);

}  // namespace octocell::bench
