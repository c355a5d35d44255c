// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "core/half_shell.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/borders.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/half_shell/hits.hpp"
#include "impl_cpu/half_shell/row_cursor.hpp"

namespace octocell::cpu::half_shell {

/// One thread's work on one level: tests its rows against themselves and their half shell.
///
/// Consecutive spheres of a row are in the lanes; spheres that may be near one of them are tested
/// one after another. For two different rows, only spheres near their common border are listed and
/// tested. Rows are several diameters wide, so this leaves out most spheres.
template <PairTest test>
class SameLevel {
 public:
  /// The most spheres that sweep() takes.
  static constexpr std::uint32_t kMostSwept = block_size(4096, 32);

  SameLevel(Workspace& w, const OrderedSpheres& spheres, int level)
      : o_(spheres),
        ids_(spheres.column_ids),
        level_(w.plan.levels.level[level]),
        grid_(level_.grid),
        diameter_(2.0F * level_.r_max),
        rows_(o_.rows.data() + o_.level_rows[level], o_.rows.data() + o_.level_rows[level + 1]),
        limit_(w.plan.candidate_limit),
        hits_within_(w, spheres, spheres),
        hits_across_(w, spheres, spheres, Listed{in_lanes_}) {}

  [[nodiscard]] std::uint64_t candidates() const { return candidates_; }

  /// Tests spheres [begin, end) of the level against those of their row and of its half shell.
  void sweep(std::uint32_t begin, std::uint32_t end) {
    std::array<RowCursor, kShellRows - 1> cursors = {rows_, rows_, rows_, rows_};
    for (const ColumnRow* row = rows_.row_of(begin); row != rows_.end() && row->begin < end;
         ++row) {
      const IndexRange all = {row->begin, (row + 1)->begin};
      const IndexRange part = {std::max(all.begin, begin), std::min(all.end, end)};
      sweep_row(*row, part, all);
      const Place at = place_of(*row, part);
      for (std::size_t k = 0; k < cursors.size(); ++k) {
        const RowStep step = shell_row(static_cast<int>(k) + 1);
        const auto there = row_one_step(at, step, cursors[k]);
        if (there) sweep_rows(*row, part, *there, strips(at, step));
      }
    }
  }

 private:
  using Neighbours = Lanes<test, kLanes>;

  struct Place {
    std::uint32_t y;
    std::uint32_t z;
    Border below_y, above_y, above_z;
  };
  Place place_of(const ColumnRow& row, IndexRange part) const {
    const std::uint32_t number = row.first_id - level_.first_id;
    Place at = {};
    at.z = number / grid_.stride_z;
    at.y = (number - at.z * grid_.stride_z) / grid_.stride_y;
    if (const auto y = cell_of_part(1, at.y, part)) {
      at.below_y = border_below(grid_, 1, *y, diameter_);
      at.above_y = border_below(grid_, 1, *y + 1, diameter_);
    }
    if (const auto z = cell_of_part(2, at.z, part)) {
      at.above_z = border_below(grid_, 2, *z + 1, diameter_);
    }
    return at;
  }
  /// Returns the cell before wrapping; none if the row's spheres lie in several cells with the same
  /// id.
  std::optional<std::uint32_t> cell_of_part(int axis, std::uint32_t wrapped,
                                            IndexRange part) const {
    if (!grid_.wraps(axis)) return wrapped;
    const float* const values = axis == 1 ? o_.y.data() : o_.z.data();
    return common_cell(grid_, axis, {values + part.begin, values + part.end});
  }

  /// A row that is adjacent to another, and its spheres.
  struct OtherRow {
    std::uint32_t first_id;
    IndexRange spheres;
  };
  std::optional<OtherRow> row_one_step(const Place& at, RowStep step, RowCursor& cursor) const {
    std::uint32_t y = at.y;
    std::uint32_t z = at.z;
    if (!step_along(grid_, 1, step.y, y) || !step_along(grid_, 2, step.z, z)) return std::nullopt;
    const std::uint32_t id = level_.first_id + y * grid_.stride_y + z * grid_.stride_z;
    const IndexRange spheres = cursor.run_at(id);
    if (spheres.empty()) return std::nullopt;
    return OtherRow{id, spheres};
  }

  /// Where partners lie: in a row, and in the row one step further.
  struct Strips {
    Strip here;
    Strip there;
  };
  static Strips strips(const Place& at, RowStep step) {
    Strips found;
    if (step.y > 0) {
      found.here.lowest_y = at.above_y.lower;
      found.there.highest_y = at.above_y.upper;
    } else if (step.y < 0) {
      found.here.highest_y = at.below_y.upper;
      found.there.lowest_y = at.below_y.lower;
    }
    if (step.z > 0) {
      found.here.lowest_z = at.above_z.lower;
      found.there.highest_z = at.above_z.upper;
    }
    return found;
  }

  /// Spheres in the lanes, and the columns that they are in.
  struct Group {
    std::uint32_t begin;
    std::uint32_t size;
    std::uint32_t first_column;
    std::uint32_t last_column;
  };

  /// If x wraps, partners of the first columns lie in the last ones, too.
  [[nodiscard]] bool wraps_down(const Group& g) const {
    return grid_.wraps(0) && g.first_column < level_.column_reach;
  }
  [[nodiscard]] bool wraps_up(const Group& g) const {
    return grid_.wraps(0) && g.last_column + level_.column_reach >= grid_.period(0);
  }
  [[nodiscard]] bool is_at_seam(const Group& g) const { return wraps_down(g) || wraps_up(g); }
  /// Return the first and the last column that may hold partners of the group, without wrapping.
  [[nodiscard]] std::uint32_t first_near(const Group& g) const {
    return g.first_column - std::min(g.first_column, level_.column_reach);
  }
  [[nodiscard]] std::uint32_t last_near(const Group& g) const {
    return std::min(g.last_column + level_.column_reach, grid_.period(0) - 1);
  }

  /// Tests a row against itself: each sphere against those behind it.
  void sweep_row(const ColumnRow& row, IndexRange part, IndexRange all) {
    std::uint32_t near_end = part.begin;
    for (std::uint32_t i = part.begin; i < part.end && candidates_ <= limit_; i += kLanes) {
      const std::uint32_t size = std::min(kLanes, part.end - i);
      const Group g = {i, size, ids_[i] - row.first_id, ids_[i + size - 1] - row.first_id};
      near_end = first_above(ids_, near_end, row.first_id + last_near(g));
      const std::uint32_t end = wraps_down(g) ? all.end : near_end;
      candidates_ += std::uint64_t{size} * (size - 1) / 2 + std::uint64_t{size} * (end - i - size);
      hits_within_.find_behind(i, size, Neighbours(o_.fields<test>(), i), {i + 1, end});
    }
  }

  /// Tests a part of a row against another row.
  void sweep_rows(const ColumnRow& row, IndexRange part, const OtherRow& other,
                  const Strips& strips) {
    const IndexRange lanes = list_lanes(strips.here, part);
    if (lanes.empty()) return;
    IndexRange left = near_part(group_of(row, lanes.begin, lanes.end - lanes.begin), other);
    while (!left.empty()) {
      const IndexRange some = {left.begin, std::min(left.end, left.begin + kMostSwept)};
      list_ones(strips.there, some);
      sweep_lists(row, lanes, other);
      left.begin = some.end;
    }
  }

  /// Returns the group of spheres from `begin` on in the list in_lanes_.
  [[nodiscard]] Group group_of(const ColumnRow& row, std::uint32_t begin,
                               std::uint32_t size) const {
    return {begin, size, ids_[in_lanes_[begin]] - row.first_id,
            ids_[in_lanes_[begin + size - 1]] - row.first_id};
  }

  /// Returns the spheres of another row in columns near the group.
  IndexRange near_part(const Group& g, const OtherRow& other) const {
    const IndexRange all = other.spheres;
    if (is_at_seam(g)) return all;
    return with_ids(ids_, all, other.first_id + first_near(g), other.first_id + last_near(g));
  }

  void sweep_lists(const ColumnRow& row, IndexRange lanes, const OtherRow& other) {
    IndexRange near = {0, 0};
    for (std::uint32_t i = lanes.begin; i < lanes.end && candidates_ <= limit_; i += kLanes) {
      const Group g = group_of(row, i, std::min(kLanes, lanes.end - i));
      if (is_at_seam(g)) {
        test_group(g, {0, ones_size_});
        continue;
      }
      if (const std::uint32_t first = first_near(g); first > 0) {
        near.begin = first_above(ones_ids_, near.begin, other.first_id + first - 1);
      }
      near.end =
          first_above(ones_ids_, std::max(near.begin, near.end), other.first_id + last_near(g));
      test_group(g, near);
    }
  }

  void test_group(const Group& g, IndexRange ones) {
    candidates_ += std::uint64_t{g.size} * (ones.end - ones.begin);
    hits_across_.find(g.begin, g.size, lanes_of(g), ones, Listed{ones_});
  }

  /// Gathers the group's spheres, which lie apart. Unused lanes hold the last sphere again.
  Neighbours lanes_of(const Group& g) const {
    using Number = NumberOf<test>;
    const FieldsOf<test> all = o_.fields<test>();
    alignas(64) Number x[kLanes], y[kLanes], z[kLanes], r[kLanes];
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t k = in_lanes_[g.begin + std::min(lane, g.size - 1)];
      x[lane] = all.x[k];
      y[lane] = all.y[k];
      z[lane] = all.z[k];
      r[lane] = all.r[place_of_radius<test>(k)];
    }
    return Neighbours({x, y, z, r}, 0);
  }

  /// Returns which of the spheres from k on lie in the strip.
  [[nodiscard]] LaneBits in_strip(const Strip& strip, std::uint64_t k) const {
    using Floats = Vector<float, kLanes>;
    const Floats y(&o_.y[k], stdx::element_aligned);
    const Floats z(&o_.z[k], stdx::element_aligned);
    return bits_of(y > strip.lowest_y && y < strip.highest_y && z > strip.lowest_z &&
                   z < strip.highest_z);
  }

  IndexRange list_lanes(const Strip& strip, IndexRange part) {
    if (lanes_size_ + (part.end - part.begin) > kMostListed) {
      hits_across_.decide();
      lanes_size_ = 0;
    }
    const std::uint32_t begin = lanes_size_;
    for (std::uint32_t k = part.begin; k < part.end; k += kLanes) {
      const LaneBits found = in_strip(strip, k) & first_bits(part.end - k);
      list_places(found, k, in_lanes_ + lanes_size_);
      lanes_size_ += static_cast<std::uint32_t>(std::popcount(found));
    }
    return {begin, lanes_size_};
  }

  void list_ones(const Strip& strip, IndexRange run) {
    ones_size_ = 0;
    for (std::uint32_t k = run.begin; k < run.end; k += kLanes) {
      __builtin_prefetch(&o_.x[k]);  // will be read next, at scattered places
      const LaneBits found = in_strip(strip, k) & first_bits(run.end - k);
      list_places(found, k, ones_ + ones_size_);
      list_values(found, ids_ + k, ones_ids_ + ones_size_);
      ones_size_ += static_cast<std::uint32_t>(std::popcount(found));
    }
    std::fill_n(ones_ids_ + ones_size_, kPassed, ~0U);
  }

  static constexpr std::uint32_t kMostListed = 2 * kMostSwept;
  static_assert(kPassed >= kMostLanes);  // that many numbers may be written behind a list

  const OrderedSpheres& o_;
  const std::uint32_t* const ids_;
  const Level& level_;
  const Grid& grid_;
  const float diameter_;
  RowCursor rows_;
  const std::uint64_t limit_;
  std::uint64_t candidates_ = 0;
  std::uint32_t in_lanes_[kMostListed + kMostLanes];  // spheres; hits hold indices into this list
  std::uint32_t lanes_size_ = 0;
  std::uint32_t ones_[kMostSwept + kMostLanes];   // spheres of the other row
  std::uint32_t ones_ids_[kMostSwept + kPassed];  // the ids of their columns
  std::uint32_t ones_size_ = 0;
  Hits<test> hits_within_;
  Hits<test, Listed> hits_across_;
};

}  // namespace octocell::cpu::half_shell
