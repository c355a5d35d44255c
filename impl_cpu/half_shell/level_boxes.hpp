// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/half_shell/hits.hpp"
#include "impl_cpu/half_shell/row_cursor.hpp"

namespace octocell::cpu::half_shell {

/// One thread's work on one level: tests single spheres of other levels, mostly coarser ones,
/// against the spheres of this level in their boxes. The two may belong to different structures.
template <PairTest test>
class LevelBoxes {
 public:
  LevelBoxes(Workspace& w, const OrderedSpheres& spheres, const OrderedSpheres& others, int level)
      : o_(spheres),
        others_(others),
        ids_(spheres.column_ids),
        level_(w.plan.levels.level[level]),
        grid_(level_.grid),
        rows_(o_.rows.data() + o_.level_rows[level], o_.rows.data() + o_.level_rows[level + 1]),
        limit_(w.plan.candidate_limit),
        hits_(w, spheres, others) {}

  [[nodiscard]] std::uint64_t candidates() const { return candidates_; }

  /// Tests one sphere of another level against the spheres of this level in its box.
  void test_box(std::uint32_t sphere) {
    const Sphere s = others_.at<test>(sphere);
    const float extent = std::nextafter(s.r + level_.r_max, HUGE_VALF);
    const CellRange box = cells_met(grid_, s, extent);
    for_each_z(box, [&](std::uint64_t first_id, std::uint64_t last_id) {
      const ColumnRow* row = rows_.not_before(first_id);
      for (; row != rows_.end() && row->first_id <= last_id; ++row) {
        test_one(sphere, columns_in(*row, box.lowest.x, box.highest.x));
      }
      return row;
    });
  }

 private:
  using Neighbours = Lanes<test, kLanes>;

  /// Loads a vector of spheres from `begin` on; the caller masks those that are not of its run.
  Neighbours lanes_at(std::uint32_t begin) const { return Neighbours(o_.fields<test>(), begin); }

  /// Tests one sphere, which is not in the run, against the run.
  void test_one(std::uint32_t sphere, IndexRange run) {
    if (candidates_ > limit_) return;
    candidates_ += run.end - run.begin;
    for (std::uint32_t j = run.begin; j < run.end; j += kLanes) {
      const LaneBits found = lanes_at(j).may_overlap(others_.fields<test>(), sphere);
      hits_.add(j, static_cast<LaneBits>(found & first_bits(run.end - j)), sphere);
    }
  }

  /// Returns the spheres of a row in columns first..last of the unwrapped axis.
  IndexRange columns_in(const ColumnRow& row, std::uint32_t first, std::uint32_t last) const {
    const IndexRange all = {row.begin, (&row + 1)->begin};
    const std::uint32_t period = grid_.period(0);
    if (grid_.wraps(0) && (last - first >= period || first / period != last / period)) return all;
    const std::uint64_t row_id = row.first_id;
    return with_ids(ids_, all, row_id + first % period, row_id + last % period);
  }

  /// Calls test_rows(first id, last id) for the rows of each z that the box meets. test_rows
  /// returns the row behind them, so that empty layers are skipped, not visited.
  template <typename TestRows>
  void for_each_z(const CellRange& box, const TestRows& test_rows) {
    const auto [y_parts, y_count] = periods(1, box.lowest.y, box.highest.y);
    const auto [z_parts, z_count] = periods(2, box.lowest.z, box.highest.z);
    for (int zp = 0; zp < z_count; ++zp) {
      for (std::uint64_t z = z_parts[zp].begin; z < z_parts[zp].end;) {
        std::uint64_t next_z = z + 1;
        const std::uint64_t layer = level_.first_id + z * grid_.stride_z;
        for (int yp = 0; yp < y_count; ++yp) {
          const ColumnRow* const behind =
              test_rows(layer + y_parts[yp].begin * std::uint64_t{grid_.stride_y},
                        layer + (y_parts[yp].end - 1) * std::uint64_t{grid_.stride_y});
          if (yp + 1 < y_count) continue;
          if (behind == rows_.end())
            next_z = z_parts[zp].end;
          else
            next_z = std::max<std::uint64_t>(next_z,
                                             (behind->first_id - level_.first_id) / grid_.stride_z);
        }
        z = next_z;
      }
    }
  }

  /// Returns cells low..high of an axis, which may wrap, as at most two runs of cells with ids.
  std::pair<std::array<IndexRange, 2>, int> periods(int axis, std::uint32_t low,
                                                    std::uint32_t high) const {
    const std::uint32_t period = grid_.period(axis);
    if (high - low >= period) return {{IndexRange{0, period}}, 1};
    const std::uint32_t first = low & grid_.wrap_mask[axis];
    const std::uint32_t last = high & grid_.wrap_mask[axis];
    if (first <= last) return {{IndexRange{first, last + 1}}, 1};
    return {{IndexRange{0, last + 1}, IndexRange{first, period}}, 2};
  }

  const OrderedSpheres& o_;
  const OrderedSpheres& others_;  // usually the same
  const std::uint32_t* const ids_;
  const Level& level_;
  const Grid& grid_;
  RowCursor rows_;
  const std::uint64_t limit_;
  Hits<test> hits_;
  std::uint64_t candidates_ = 0;
};

}  // namespace octocell::cpu::half_shell
