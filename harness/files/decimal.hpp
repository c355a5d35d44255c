// SPDX-License-Identifier: MIT
// Decimal numbers in text files.
#pragma once

#include <string_view>

namespace octocell {

/// The result of reading a decimal number, rounded once to float32, ties to even.
struct DecimalFloat {
  enum class Kind : unsigned char { number, not_a_number, too_large };
  Kind kind;
  float value;  // valid if `kind` is number; "nan" and "inf" are numbers here
};
DecimalFloat parse_float(std::string_view text);

}  // namespace octocell
