// SPDX-License-Identifier: MIT
// Decimal numbers in text files.
#pragma once

#include <string_view>

namespace octocell {

/// What was read as a decimal number, rounded once to float32, to nearest even.
struct DecimalFloat {
  enum class Kind : unsigned char { number, not_a_number, too_large };
  Kind kind;
  float value;  // of a number; "nan" and "inf" are numbers here
};
DecimalFloat parse_float(std::string_view text);

}  // namespace octocell
