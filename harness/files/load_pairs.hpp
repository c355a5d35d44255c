// SPDX-License-Identifier: MIT
// Reads a list of pairs that another program wrote.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace octocell {

/// Two numbers as a file holds them, in any order. They may name no sphere.
struct ListedPair {
  std::int64_t i;
  std::int64_t j;
  friend constexpr bool operator==(const ListedPair&, const ListedPair&) = default;
};

/// Reads NPY of shape (m, 2) and any integer type, or text with two numbers a line: commas,
/// semicolons, tabs or blanks between, '#' before a comment, a first line of words as a header. "-"
/// is standard input. The first bytes tell NPY from text. An empty file holds no pairs. uint64
/// numbers of 2^63 and more wrap to negative ones. Throws InputError with the path and, for text,
/// the line.
std::vector<ListedPair> load_pairs(const std::string& path);

}  // namespace octocell
