// SPDX-License-Identifier: MIT
// How the bits of a key are cut into digits. Each pass of a sort handles one digit.
#pragma once

#include <array>

namespace octocell {

/// The digit of a key is (key >> shift) & ((1 << width) - 1).
struct Digit {
  int shift;
  int width;
};

struct DigitPlan {
  int passes = 0;
  std::array<Digit, 32> digits{};  // [passes], the lowest first
  /// Returns the width of the widest digit; 0 if there is none.
  [[nodiscard]] constexpr int width() const { return passes == 0 ? 0 : digits[0].width; }
};

/// Returns how many digits of at most `digit_bits` bits a key has.
constexpr int sort_passes(int key_bits, int digit_bits) {
  return (key_bits + digit_bits - 1) / digit_bits;
}

/// Plans as few passes as digits of at most `widest` bits allow, because each pass moves every pair
/// once. Then makes the digits as even as possible, because a bin costs the same however few keys
/// fall into it. With `widest` 10, 17 bits become 9 + 8 and not 10 + 7, and 32 bits 8 + 8 + 8 + 8.
/// Wider digits come first.
constexpr DigitPlan digit_plan(int bits, int widest) {
  DigitPlan plan;
  plan.passes = sort_passes(bits, widest);
  int shift = 0;
  for (int pass = 0; pass < plan.passes; ++pass) {
    const int width = bits / plan.passes + (pass < bits % plan.passes ? 1 : 0);
    plan.digits[pass] = {shift, width};
    shift += width;
  }
  return plan;
}

}  // namespace octocell
