// SPDX-License-Identifier: MIT
// What is sorted: how many pairs, how wide the keys are, and in which order.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace octocell::bench {

enum class Order : std::uint8_t {
  random,        // uniform
  sorted,        // the same keys, ascending
  reversed,      // the same keys, descending
  constant,      // one key
  few_distinct,  // sixteen keys, far apart, in random order
};
inline constexpr std::string_view kOrderNames[] = {"random", "sorted", "reversed", "constant",
                                                   "few_distinct"};
inline std::string_view name_of(Order order) {
  return kOrderNames[static_cast<std::size_t>(order)];
}

/// The rows of one case are interleaved.
struct SortCase {
  std::uint32_t n;
  int bits;  // keys are below 2^bits
  Order order;
  bool slow_rows = true;  // false: comparison sorts would take too long for this preset
};

/// Returns the cases of a preset, small ones first. Throws InputError for an unknown preset.
std::vector<SortCase> sort_cases(std::string_view preset);

/// Returns the cases for the GPU, which sorts more in less time.
std::vector<SortCase> gpu_sort_cases(std::string_view preset);

/// Returns the keys of a case, the same on every machine.
std::vector<std::uint32_t> make_keys(const SortCase& what);

}  // namespace octocell::bench
