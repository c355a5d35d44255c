// SPDX-License-Identifier: MIT
// Text from files and arguments, and how messages show it.
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

}  // namespace octocell
