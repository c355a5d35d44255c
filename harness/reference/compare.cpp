// SPDX-License-Identifier: MIT
#include "harness/reference/reference.hpp"

namespace octocell::reference {

Comparison compare(std::span<const Pair> answer, std::span<const Pair> truth) {
  Comparison difference;
  auto expected = truth.begin();
  for (std::size_t k = 0; k < answer.size(); ++k) {
    if (k > 0 && answer[k] == answer[k - 1]) {
      ++difference.duplicates;
      continue;
    }
    while (expected != truth.end() && *expected < answer[k]) {
      ++difference.missed;
      ++expected;
    }
    if (expected != truth.end() && *expected == answer[k]) {
      ++expected;
    } else {
      ++difference.false_pairs;
    }
  }
  difference.missed += static_cast<std::uint64_t>(truth.end() - expected);
  return difference;
}

}  // namespace octocell::reference
