// SPDX-License-Identifier: MIT
#include "harness/files/table_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/text.hpp"
#include "harness/files/table_line.hpp"

namespace octocell {
namespace {

/// Other names for a column. ParaView writes Points:0 to Points:2.
constexpr std::pair<std::string_view, Column> kOtherNames[] = {{"radius", Column::r},
                                                               {"points:0", Column::x},
                                                               {"points:1", Column::y},
                                                               {"points:2", Column::z}};

std::optional<Column> column_called(const std::string& name) {
  const auto* const known = std::ranges::find(kColumnNames, name);
  if (known != kColumnNames.end()) return static_cast<Column>(known - kColumnNames.begin());
  for (const auto& [other, column] : kOtherNames) {
    if (name == other) return column;
  }
  return std::nullopt;
}

/// Returns "x y z r" for "x_y_z_r".
std::string words_of_yade(std::string_view format) {
  std::string words(format);
  std::ranges::replace(words, '_', ' ');
  return words;
}

/// Returns for instance "id,x,y and 12 more".
std::string shortened(std::span<const std::string> names) {
  constexpr std::size_t kMost = 8;
  const auto shown = names.first(std::min(names.size(), kMost));
  const std::string text = printable(fmt::format("{}", fmt::join(shown, ",")));
  const std::size_t more = names.size() - shown.size();
  return more == 0 ? text : fmt::format("{} and {} more", text, more);
}

}  // namespace

std::optional<TableColumns> TableColumns::named_by(std::span<const std::string_view> header) {
  TableColumns columns;
  columns.field_.fill(kNoField);
  for (std::size_t k = 0; k < header.size(); ++k) {
    columns.names_.emplace_back(header[k]);
    const auto column = column_called(lower_case(header[k]));
    if (!column) {
      if (!header[k].empty()) columns.unread_.emplace_back(header[k]);
      continue;
    }
    std::size_t& field = columns.field_[static_cast<std::size_t>(*column)];
    if (field != kNoField) return std::nullopt;
    field = k;
  }
  const bool is_header =
      columns.have(Column::x) && columns.have(Column::y) && columns.have(Column::z);
  return is_header ? std::optional(std::move(columns)) : std::nullopt;
}

std::optional<TableColumns> TableColumns::named_by_comment(std::string_view comment) {
  constexpr std::string_view kYade = "format ";
  const std::string words = comment.starts_with(kYade) ? words_of_yade(comment.substr(kYade.size()))
                                                       : std::string(comment);
  std::vector<std::string_view> names;
  split_fields(words, separator_in(words, false), names);
  return named_by(names);
}

std::optional<TableColumns> TableColumns::without_header(std::size_t field_count) {
  constexpr std::string_view kNames[] = {"id", "x", "y", "z", "r"};
  const auto names = std::span(kNames);
  switch (field_count) {
    case 3:
      return named_by(names.subspan(1, 3));
    case 4:
      return named_by(names.subspan(1));
    case 5:
      return named_by(names);
    default:
      return std::nullopt;
  }
}

bool TableColumns::have_flags() const {
  return have(Column::is_static) || have(Column::group) || have(Column::mask);
}

std::string TableColumns::text() const { return shortened(names_); }

std::string TableColumns::unread_text() const { return shortened(unread_); }

}  // namespace octocell
