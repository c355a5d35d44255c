// SPDX-License-Identifier: MIT
// Takes the word of Flags apart by its definition: division, and one group after another.
#include <cstdint>

#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {
namespace {

constexpr int kGroups = 15;

/// Returns the binary digit of weight 2^place.
bool digit(std::uint32_t number, int place) {
  for (; place > 0; --place) number /= 2;
  return number % 2 == 1;
}

bool is_in_group(Flags f, int group) { return digit(f.word, group); }
bool stands_still(Flags f) { return digit(f.word, 15); }
bool looks_for(Flags f, int group) { return digit(f.word, 16 + group); }

bool meets(Flags a, Flags b) {
  for (int group = 0; group < kGroups; ++group) {
    if (is_in_group(a, group) && looks_for(b, group)) return true;
  }
  return false;
}

}  // namespace

bool allowed(Flags a, Flags b) {
  if (stands_still(a) && stands_still(b)) return false;
  return meets(a, b) && meets(b, a);
}

}  // namespace octocell::reference
