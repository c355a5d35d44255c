// SPDX-License-Identifier: MIT
// Whether an answer is right, by other means than sorting.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace octocell::bench {

/// A sum over the (key, value) pairs that does not depend on their order.
std::uint64_t pairs_checksum(std::span<const std::uint32_t> keys,
                             std::span<const std::uint32_t> values);

/// What is known of the right answer. Values of the input are 0, 1, 2, ..., so equal keys kept
/// their order if their values ascend.
struct SortTruth {
  std::size_t size = 0;
  std::uint64_t checksum = 0;
};

/// One line that says what is wrong first, or nothing. `stable`: equal keys must have kept their
/// order.
std::optional<std::string> fault_of(std::span<const std::uint32_t> keys,
                                    std::span<const std::uint32_t> values, const SortTruth& truth,
                                    bool stable);

}  // namespace octocell::bench
