// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/half_shell.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/half_shell/hits.hpp"
#include "impl_cpu/half_shell/row_cursor.hpp"

namespace octocell::cpu::half_shell {

/// One thread's work on one level: tests a few spheres, row by row, against the many of the level.
///
/// Few spheres would leave most lanes empty. So the many are in the lanes, and of a row only those
/// that are near in x. Each of the few visits only those of the nine adjacent rows that its box
/// meets.
template <PairTest test>
class OtherRows {
 public:
  OtherRows(Workspace& w, const OrderedSpheres& many, const OrderedSpheres& few, int level)
      : many_(many),
        few_(few),
        level_(w.plan.levels.level[level]),
        grid_(level_.grid),
        rows_(many.rows.data() + many.level_rows[level],
              many.rows.data() + many.level_rows[level + 1]),
        rows_of_few_(few.rows.data() + few.level_rows[level],
                     few.rows.data() + few.level_rows[level + 1]),
        boxes_pay_(level_.r_max < kNarrow * grid_.cell_side),
        limit_(w.plan.candidate_limit),
        hits_(w, many, few) {}

  [[nodiscard]] std::uint64_t candidates() const { return candidates_; }

  /// Tests spheres [begin, end) of the few.
  void sweep(std::uint32_t begin, std::uint32_t end) {
    RowCursor cursors[] = {rows_, rows_, rows_};
    for (const ColumnRow* row = rows_of_few_.row_of(begin);
         row != rows_of_few_.end() && row->begin < end; ++row) {
      Adjacent at = adjacent_to(*row, cursors);
      const std::uint32_t last = std::min((row + 1)->begin, end);
      for (std::uint32_t i = std::max(row->begin, begin); i < last && candidates_ <= limit_; ++i) {
        visit_rows(i, few_.column_ids[i] - row->first_id, at);
      }
    }
  }

 private:
  /// The rows of the many from y - 1 to y + 1 in the layers z - 1 to z + 1.
  struct Adjacent {
    std::uint32_t first_id[9];
    std::uint32_t begin[9];   // moves forward along the row
    std::uint32_t exist = 0;  // one bit each
  };

  Adjacent adjacent_to(const ColumnRow& row, RowCursor (&cursors)[3]) const {
    const std::uint32_t number = row.first_id - level_.first_id;
    const std::uint32_t z = number / grid_.stride_z;
    const std::uint32_t y = (number - z * grid_.stride_z) / grid_.stride_y;
    Adjacent found;
    for (int step_z = 0; step_z < 3; ++step_z) {
      std::uint32_t there_z = z;
      if (!step_along(grid_, 2, step_z - 1, there_z)) continue;
      list_layer(y, level_.first_id + there_z * grid_.stride_z, cursors[step_z], 3 * step_z, found);
    }
    return found;
  }

  /// Lists rows y - 1 to y + 1 of a layer. They follow one another, except for one that may lie
  /// beyond a wrapped border.
  void list_layer(std::uint32_t y, std::uint32_t layer_id, RowCursor& cursor, int first,
                  Adjacent& found) const {
    const std::uint32_t last = grid_.period(1) - 1;
    const auto list = [&](const ColumnRow* there, std::uint32_t id, int k) {
      if (there == rows_.end() || there->first_id != id) return;
      found.first_id[k] = id;
      found.begin[k] = there->begin;
      found.exist |= 1U << k;
    };
    const int lowest = y > 0 ? 0 : 1;
    const int highest = y < last ? 2 : 1;
    std::uint32_t id = layer_id + (y - (y > 0 ? 1 : 0)) * grid_.stride_y;
    const ColumnRow* there = cursor.not_before(id);
    for (int k = lowest; k <= highest; ++k, id += grid_.stride_y) {
      if (there != rows_.end() && there->first_id < id) ++there;
      list(there, id, first + k);
    }
    if (!grid_.wraps(1) || (y > 0 && y < last)) return;
    const std::uint32_t around = layer_id + (y == 0 ? last : 0) * grid_.stride_y;
    list(cursor.not_before(around), around, first + (y == 0 ? 0 : 2));
  }

  /// The columns around one of the few, and the adjacent rows that its box meets.
  struct Box {
    std::uint32_t first_column;  // not below that of the sphere before
    std::uint32_t last_column;
    std::uint32_t rows;  // one bit each
  };

  Box box_of(const Sphere& s, std::uint32_t column) {
    if (!boxes_pay_) {
      const std::uint32_t last = grid_.period(0) - 1;
      if (grid_.wraps(0)) return {0, last, kAllRows};
      return {column - std::min(column, level_.column_reach),
              std::min(column + level_.column_reach, last), kAllRows};
    }
    if (s.r != radius_) {
      radius_ = s.r;
      extent_ = std::nextafter(s.r + level_.r_max, HUGE_VALF);
    }
    const auto steps = [&](int axis, float centre) {
      const std::uint32_t home = cell_coordinate(grid_, axis, centre);
      const bool below = cell_coordinate(grid_, axis, centre - extent_) < home;
      const bool above = cell_coordinate(grid_, axis, centre + extent_) > home;
      return std::pair{below, above};
    };
    const auto [y_below, y_above] = steps(1, s.y);
    const auto [z_below, z_above] = steps(2, s.z);
    const std::uint32_t in_layer = (y_below ? 1U : 0U) | 2U | (y_above ? 4U : 0U);
    const std::uint32_t rows =
        (z_below ? in_layer : 0U) | in_layer << 3 | (z_above ? in_layer << 6 : 0U);
    if (grid_.wraps(0)) return {0, grid_.period(0) - 1, rows};
    return {column - std::min(column, level_.column_reach),
            cell_coordinate(grid_, 0, s.x + extent_), rows};
  }

  void visit_rows(std::uint32_t sphere, std::uint32_t column, Adjacent& at) {
    const Box box = box_of(few_.at<test>(sphere), column);
    for_each_lane(box.rows & at.exist, [&](std::uint32_t k) {
      const std::uint32_t first_id = at.first_id[k];
      if (box.first_column > 0) {
        at.begin[k] = first_above(many_.column_ids, at.begin[k], first_id + box.first_column - 1);
      }
      visit_row(sphere, at.begin[k], first_id + box.last_column);
    });
  }

  /// Tests the sphere against the row from `begin` on, up to id `last_id`.
  void visit_row(std::uint32_t sphere, std::uint32_t begin, std::uint32_t last_id) {
    for (std::uint32_t j = begin;; j += kLanes) {
      const Ids ids(many_.column_ids + j, stdx::element_aligned);
      const LaneBits near = bits_of(ids <= last_id);
      const Lanes<test, kLanes> lanes(many_.fields<test>(), j);
      const LaneBits found = lanes.may_overlap(few_.fields<test>(), sphere);
      hits_.add(j, static_cast<LaneBits>(found & near), sphere);
      candidates_ += static_cast<std::uint64_t>(std::popcount(near));
      if (near != first_bits(kLanes)) return;
    }
  }
  static_assert(Ids::size() == kLanes);

  static constexpr std::uint32_t kAllRows = (1U << 9) - 1;
  static constexpr double kNarrow = 0.4;  // above it, a box meets nearly all nine rows

  const OrderedSpheres& many_;
  const OrderedSpheres& few_;
  const Level& level_;
  const Grid& grid_;
  RowCursor rows_;
  RowCursor rows_of_few_;
  const bool boxes_pay_;
  const std::uint64_t limit_;
  Hits<test> hits_;
  std::uint64_t candidates_ = 0;
  float radius_ = -1.0F;  // of the last sphere
  float extent_ = 0.0F;
};

}  // namespace octocell::cpu::half_shell
