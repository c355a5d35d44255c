// SPDX-License-Identifier: MIT
#include "harness/files/table_line.hpp"

#include <algorithm>

#include "core/text.hpp"

namespace octocell {
namespace {

constexpr std::string_view kMarks[] = {";", ",", "\t", " \t"};  // by Separator

std::string_view marks_of(Separator separator) {
  return kMarks[static_cast<std::size_t>(separator)];
}

/// Returns the position of the first of `marks` outside of quotes, or the text's length.
std::size_t find_unquoted(std::string_view text, std::string_view marks) {
  const std::size_t first = std::min(text.find_first_of(marks), text.size());
  if (text.substr(0, first).find('"') == std::string_view::npos) return first;
  bool is_quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '"') is_quoted = !is_quoted;
    if (!is_quoted && marks.find(text[k]) != std::string_view::npos) return k;
  }
  return text.size();
}

std::string_view without_quotes(std::string_view field) {
  const bool is_quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return is_quoted ? trim(field.substr(1, field.size() - 2)) : field;
}

}  // namespace

Separator separator_in(std::string_view line, bool decimal_comma) {
  const std::string_view text = trim(line);
  const auto holds = [text](Separator s) { return text.find_first_of(marks_of(s)) < text.size(); };
  if (holds(Separator::semicolon)) return Separator::semicolon;
  if (!decimal_comma && holds(Separator::comma)) return Separator::comma;
  return holds(Separator::tab) ? Separator::tab : Separator::blanks;
}

std::string_view name_of(Separator separator) {
  constexpr std::string_view kNames[] = {"semicolons", "commas", "tabs", "blanks"};
  return kNames[static_cast<std::size_t>(separator)];
}

TableLine split_comment(std::string_view line) {
  const std::size_t mark = trim(line).starts_with('%') ? line.find('%') : find_unquoted(line, "#");
  return {line.substr(0, mark), trim(line.substr(std::min(mark + 1, line.size())))};
}

void split_fields(std::string_view text, Separator separator,
                  std::vector<std::string_view>& fields) {
  fields.clear();
  const std::string_view marks = marks_of(separator);
  while (true) {
    if (separator == Separator::blanks) {
      text.remove_prefix(std::min(text.find_first_not_of(marks), text.size()));
      if (text.empty()) return;
    }
    const std::size_t end = find_unquoted(text, marks);
    fields.push_back(without_quotes(trim(text.substr(0, end))));
    if (end == text.size()) return;
    text.remove_prefix(end + 1);
  }
}

}  // namespace octocell
