// SPDX-License-Identifier: MIT
// Reading numbers from text files, and showing their text in messages.
#pragma once

#include <string>
#include <string_view>

namespace octocell {

/// `text` in quotes, short, with anything but printable ASCII escaped: safe on a terminal.
std::string quote(std::string_view text);

/// `text` as it may be shown: line breaks, other control characters and bytes that are not UTF-8
/// are escaped as \xNN, so that no name makes two lines, moves a cursor or spoils JSON.
std::string printable(std::string_view text);

std::string_view trim(std::string_view text);  // blanks, tabs and carriage returns

std::string lower_case(std::string_view text);  // ASCII

/// What was read as a decimal number, rounded once to float32, to nearest even.
struct DecimalFloat {
  enum class Kind : unsigned char { number, not_a_number, too_large };
  Kind kind;
  float value;  // of a number; "nan" and "inf" are numbers here
};
DecimalFloat parse_float(std::string_view text);

}  // namespace octocell
