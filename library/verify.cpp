// SPDX-License-Identifier: MIT
// Compares a list of pairs with the answer, which comes in chunks: it need not fit into memory.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "core/pair.hpp"
#include "include/octocell/octocell.hpp"
#include "library/errors.hpp"

namespace octocell {
namespace {

constexpr std::uint64_t kPairsPerChunk = 16'000'000;

void note(std::uint64_t& number, std::optional<Pair>& first, Pair pair) {
  if (number++ == 0) first = pair;
}

std::vector<Pair> sorted_copy(std::span<const Pair> pairs) {
  require_memory(static_cast<double>(pairs.size_bytes()), "a sorted copy of the pairs");
  std::vector<Pair> sorted;
  sorted.reserve(pairs.size());
  for (const Pair& pair : pairs) sorted.push_back(make_pair_of(pair.i, pair.j));
  std::ranges::sort(sorted);
  return sorted;
}

/// Counts what the list repeats, and removes it.
void remove_duplicates(std::vector<Pair>& sorted, Verification& result) {
  auto kept = sorted.begin();
  for (const Pair& pair : sorted) {
    if (kept != sorted.begin() && *(kept - 1) == pair) {
      note(result.duplicates, result.first_duplicate, pair);
    } else {
      *kept++ = pair;
    }
  }
  sorted.erase(kept, sorted.end());
}

Verification compare(std::span<const Sphere> spheres, std::span<const Pair> pairs,
                     Options options) {
  options.sorted = true;
  Verification result;
  std::vector<Pair> listed = sorted_copy(pairs);
  remove_duplicates(listed, result);
  auto next = listed.begin();
  for (const Pairs& chunk : Chunks(spheres, kPairsPerChunk, options)) {
    for (const Pair& pair : chunk) {
      for (; next != listed.end() && *next < pair; ++next) {
        note(result.false_pairs, result.first_false, *next);
      }
      if (next != listed.end() && *next == pair) {
        ++next;
      } else {
        note(result.missed, result.first_missed, pair);
      }
    }
  }
  for (; next != listed.end(); ++next) note(result.false_pairs, result.first_false, *next);
  return result;
}

}  // namespace

Verification verify(std::span<const Sphere> spheres, std::span<const Pair> pairs,
                    const Options& options) {
  return library::with_errors([&] { return compare(spheres, pairs, options); });
}

}  // namespace octocell
