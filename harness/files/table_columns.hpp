// SPDX-License-Identifier: MIT
// The meaning of each field in a line of a table.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octocell {

/// The columns that are read. A table may have others, such as an id.
enum class Column : std::size_t { x, y, z, r, is_static, group, mask };
inline constexpr std::array<std::string_view, 7> kColumnNames = {"x",      "y",     "z",   "r",
                                                                 "static", "group", "mask"};

class TableColumns {
 public:
  /// Returns the columns of a header. None unless it names x, y and z once and the others at most
  /// once. r may be called radius.
  static std::optional<TableColumns> named_by(std::span<const std::string_view> header);

  /// Does the same for a header in a comment, with any separator, or with YADE's: "format x_y_z_r".
  static std::optional<TableColumns> named_by_comment(std::string_view comment);

  /// Returns the columns of a table without header: x y z, x y z r, or id x y z r.
  static std::optional<TableColumns> without_header(std::size_t field_count);

  [[nodiscard]] std::size_t field_count() const { return names_.size(); }
  [[nodiscard]] bool have(Column column) const { return field_of(column) != kNoField; }
  [[nodiscard]] bool have_flags() const;
  [[nodiscard]] std::size_t field_of(Column c) const { return field_[static_cast<std::size_t>(c)]; }

  [[nodiscard]] std::string text() const;         // "id,x,y,z,r", shortened if there are many
  [[nodiscard]] std::string unread_text() const;  // "id,mass"; columns without a name are left out

  friend bool operator==(const TableColumns&, const TableColumns&) = default;

 private:
  static constexpr std::size_t kNoField = static_cast<std::size_t>(-1);
  std::array<std::size_t, kColumnNames.size()> field_ = {};
  std::vector<std::string> names_;   // of all fields, in order
  std::vector<std::string> unread_;  // of the fields that are not read
};

}  // namespace octocell
