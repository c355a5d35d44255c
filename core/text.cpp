// SPDX-License-Identifier: MIT
#include "core/text.hpp"

#include <fmt/format.h>

#include <boost/locale/utf.hpp>
#include <cstdint>

namespace octocell {

namespace {

std::string escaped(char byte) {
  return fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
}

/// Returns false for control characters and for marks that change the direction of the text behind
/// them.
bool is_shown(boost::locale::utf::code_point point) {
  const auto is_from = [point](std::uint32_t first, std::uint32_t last) {
    return point >= first && point <= last;
  };
  return boost::locale::utf::is_valid_codepoint(point) && point >= 0x20 && !is_from(0x7f, 0x9f) &&
         !is_from(0x2028, 0x202e) && !is_from(0x2066, 0x2069);
}

}  // namespace

std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string quoted = "'";
  for (const char c : text.substr(0, kLongest)) {
    const bool printable = c >= ' ' && c <= '~';
    quoted += printable ? std::string(1, c) : escaped(c);
  }
  return quoted + (text.size() > kLongest ? "...'" : "'");
}

std::string printable(std::string_view text) {
  using Utf8 = boost::locale::utf::utf_traits<char>;
  std::string shown;
  for (auto next = text.begin(); next != text.end();) {
    auto end = next;
    const boost::locale::utf::code_point point = Utf8::decode(end, text.end());
    if (!boost::locale::utf::is_valid_codepoint(point))
      end = next + 1;  // one byte that is not
                       // UTF-8
    if (is_shown(point)) {
      shown.append(next, end);
    } else {
      for (auto byte = next; byte != end; ++byte) shown += escaped(*byte);
    }
    next = end;
  }
  return shown;
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

}  // namespace octocell
