// SPDX-License-Identifier: MIT
// How a list of pairs from elsewhere differs from the exact pairs of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pair.hpp"
#include "harness/files/load_pairs.hpp"

namespace octocell::judge {

/// A pair of the list, with i < j, and how often each order of the two occurs.
struct RepeatedPair {
  Pair pair;
  std::uint64_t ascending;   // rows (i, j)
  std::uint64_t descending;  // rows (j, i)
  [[nodiscard]] std::uint64_t times() const { return ascending + descending; }
};

struct Differences {
  std::uint64_t listed = 0;                    // rows of the list
  std::vector<Pair> found = {};                // pairs that are listed, and rightly
  std::vector<Pair> missed = {};               // true pairs that are not listed
  std::vector<Pair> false_pairs = {};          // pairs that are listed, and are no pairs
  std::vector<RepeatedPair> repeated = {};     // pairs that are listed more than once
  std::uint64_t duplicates = 0;                // rows that repeat a pair of another row
  std::vector<std::size_t> out_of_range = {};  // rows that name no two spheres, or one twice

  [[nodiscard]] bool exact() const {
    return missed.empty() && false_pairs.empty() && repeated.empty() && out_of_range.empty();
  }
};

/// Compares. The truth is sorted; all vectors of the answer are sorted, too.
Differences differences_of(std::span<const ListedPair> list, std::span<const Pair> truth,
                           std::size_t spheres);

/// Returns the first row that lists the pair in either order; the last row's number plus one if
/// there is none.
std::size_t row_of(std::span<const ListedPair> list, Pair pair, std::size_t occurrence = 0);

}  // namespace octocell::judge
