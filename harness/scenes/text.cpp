// SPDX-License-Identifier: MIT
#include "harness/scenes/text.hpp"
#include "harness/interface/faults.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>

namespace octocell {

std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string quoted = "'";
  for (const char c : text.substr(0, kLongest)) {
    const bool printable = c >= ' ' && c <= '~';
    quoted +=
        printable ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return quoted + (text.size() > kLongest ? "...'" : "'");
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

DecimalFloat parse_float(std::string_view text) {
  using enum DecimalFloat::Kind;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  float value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end) return {not_a_number, 0};
  if (error == std::errc{}) return {number, value};
  // Out of range is said of too large numbers and of tiny ones, which strtof rounds correctly.
  value = std::strtof(std::string(text).c_str(), nullptr);
  return {std::isinf(value) ? too_large : number, value};
}

std::optional<std::string_view> next_line(std::string_view& rest) {
  if (OCTOCELL_FAULT(text_last_line_lost, rest.find('\n') == std::string_view::npos, rest.empty()))
    return std::nullopt;
  const std::size_t end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return line;
}

}  // namespace octocell
