// SPDX-License-Identifier: MIT
// Text from files and arguments, and how messages show it.
#pragma once

#include <string>
#include <string_view>

namespace octocell {

/// Quotes and shortens `text`, and escapes everything but printable ASCII: safe on a terminal.
std::string quote(std::string_view text);

/// Escapes line breaks, other control characters and bytes that are not UTF-8 as \xNN, so that no
/// name can start a new line, move the cursor or break JSON.
std::string printable(std::string_view text);

std::string_view trim(std::string_view text);  // blanks, tabs and carriage returns

std::string lower_case(std::string_view text);  // ASCII

}  // namespace octocell
