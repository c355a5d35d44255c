// SPDX-License-Identifier: MIT
// Splits a line of a table into fields and comment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace octocell {

/// What separates two fields. `blanks` is any number of blanks and tabs.
enum class Separator : std::uint8_t { semicolon, comma, tab, blanks };

/// Returns the first of these, in this order, that the line contains. A decimal comma is no
/// separator.
Separator separator_in(std::string_view line, bool decimal_comma);

/// Returns its name for messages: "commas".
std::string_view name_of(Separator separator);

struct TableLine {
  std::string_view text;     // without comment
  std::string_view comment;  // behind '#', or behind '%' if the line begins with it
};

/// A '#' in double quotes begins no comment.
TableLine split_comment(std::string_view line);

/// Replaces `fields` by the fields of `text`, without the blanks and double quotes around them. A
/// separator in double quotes belongs to its field.
void split_fields(std::string_view text, Separator separator,
                  std::vector<std::string_view>& fields);

}  // namespace octocell
