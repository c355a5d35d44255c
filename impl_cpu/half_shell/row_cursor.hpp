// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/half_shell.hpp"

namespace octocell::cpu::half_shell {

/// Returns the spheres of a range whose ids are first..last. The ids are sorted.
inline IndexRange with_ids(const std::uint32_t* ids, IndexRange among, std::uint64_t first,
                           std::uint64_t last) {
  const auto place = [&](std::uint64_t id) {
    return static_cast<std::uint32_t>(std::lower_bound(ids + among.begin, ids + among.end, id) -
                                      ids);
  };
  return {place(first), place(last + 1)};
}

/// Finds the rows of a level by id. It is fast if the next row is near the last one: it takes
/// doubling steps from there, then halving ones (Bentley and Yao 1976, an almost optimal algorithm
/// for unbounded searching). Rows are requested nearly in order, so no table of all rows is needed,
/// however many of them are empty.
class RowCursor {
 public:
  RowCursor(const ColumnRow* begin, const ColumnRow* end) : begin_(begin), end_(end), at_(begin) {}

  /// Returns the first row whose id is at least `first_id`; end() if there is none.
  const ColumnRow* not_before(std::uint64_t first_id) {
    const ColumnRow* low = at_;
    const ColumnRow* high = at_;
    std::ptrdiff_t step = 1;
    if (at_ == end_ || at_->first_id >= first_id) {
      while (low != begin_ && (low - 1)->first_id >= first_id) {
        high = low - 1;
        low = high - std::min(step, high - begin_);
        step *= 2;
      }
    } else {
      while (high != end_ && high->first_id < first_id) {
        low = high + 1;
        high += std::min(step, end_ - high);
        step *= 2;
      }
    }
    at_ = std::ranges::lower_bound(low, high, first_id, {}, &ColumnRow::first_id);
    return at_;
  }

  /// Returns the spheres of the row with that id; an empty run if there is no such row.
  IndexRange run_at(std::uint64_t first_id) {
    const ColumnRow* const row = not_before(first_id);
    if (row == end_ || row->first_id != first_id) return {0, 0};
    return {row->begin, (row + 1)->begin};
  }

  /// Returns the row that holds that sphere of the level.
  [[nodiscard]] const ColumnRow* row_of(std::uint32_t sphere) const {
    return std::ranges::upper_bound(begin_, end_, sphere, {}, &ColumnRow::begin) - 1;
  }

  [[nodiscard]] const ColumnRow* end() const { return end_; }

 private:
  const ColumnRow* begin_;
  const ColumnRow* end_;
  const ColumnRow* at_;
};

}  // namespace octocell::cpu::half_shell
