// SPDX-License-Identifier: MIT
// Checks the assumed columns of a table without header: does the first hold ids or coordinates?
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/sphere.hpp"

namespace octocell {

/// Looks at each line of a table of four fields, read as x y z r, or of five fields, read as
/// id x y z r, for signs that the fields have another meaning.
class TableGuess {
 public:
  explicit TableGuess(std::size_t field_count) : field_count_(field_count) {}

  /// `first` is the first field of a line, `sphere` the sphere that was read from the line.
  void add(std::string_view first, const Sphere& sphere);

  /// Returns true if the lines so far may as well hold id x y z.
  [[nodiscard]] bool may_be_id_x_y_z() const { return field_count_ == 4 && may_have_ids_; }

  /// Call after the last line. Returns which other meaning is possible, and the options that tell
  /// which one is right. Empty if there is no sign of another meaning.
  [[nodiscard]] std::string other_meaning();

 private:
  [[nodiscard]] bool has_each_id_once();

  std::size_t field_count_;
  bool may_have_ids_ = true;
  std::vector<std::uint64_t> ids_;  // empty as soon as they cannot be ids
  bool all_y_whole_ = true;
  bool all_z_whole_ = true;
  bool all_z_positive_ = true;
  bool all_r_whole_ = true;
};

}  // namespace octocell
