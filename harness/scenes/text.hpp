// SPDX-License-Identifier: MIT
// Reading numbers and lines from text files, and showing their text in messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace octocell {

/// `text` in quotes, short, with anything but printable ASCII escaped: safe on a terminal.
std::string quote(std::string_view text);

std::string_view trim(std::string_view text);  // blanks, tabs and carriage returns

std::string lower_case(std::string_view text);  // ASCII

/// What was read as a decimal number, rounded once to float32, to nearest even.
struct DecimalFloat {
  enum class Kind : unsigned char { number, not_a_number, too_large };
  Kind kind;
  float value;  // of a number; "nan" and "inf" are numbers here
};
DecimalFloat parse_float(std::string_view text);

/// The next line without its end, or nothing after the last; `rest` moves past it.
std::optional<std::string_view> next_line(std::string_view& rest);

}  // namespace octocell
