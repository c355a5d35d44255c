// SPDX-License-Identifier: MIT
#include "harness/files/decimal.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>

namespace octocell {

DecimalFloat parse_float(std::string_view text) {
  using enum DecimalFloat::Kind;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  float value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end) return {not_a_number, 0};
  if (error == std::errc{}) return {number, value};
  // from_chars reports "out of range" for large and for tiny numbers; strtof rounds tiny ones
  // correctly.
  value = std::strtof(std::string(text).c_str(), nullptr);
  return {std::isinf(value) ? too_large : number, value};
}

}  // namespace octocell
