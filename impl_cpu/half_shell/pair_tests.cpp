// SPDX-License-Identifier: MIT
// Stage 5 of half_shell: which spheres of adjacent cells overlap?
// Reads ordered spheres, rows. Writes sure pairs, and doubts for stage 6.
// Cost: about one vector operation for each sphere and neighbouring row: four rows, one in a flat
//       scene, none on a line.
// Idea: spheres that follow each other in a row lie in the lanes; those of a neighbouring row that
//       may be near one of them come one after the other. Where rows are sparse these are about as
//       many, too, so looking closer gains nothing, and no branch depends on where they lie.
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "harness/interface/faults.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/half_shell/hits.hpp"
#include "impl_cpu/half_shell/other_rows.hpp"
#include "impl_cpu/half_shell/row_cursor.hpp"
#include "impl_cpu/half_shell/steps.hpp"

namespace octocell::cpu::half_shell {
namespace {

constexpr std::uint64_t kSweptPerBlock = 4096;
constexpr std::uint64_t kBoxesPerBlock = 16;

/// One step along y, z or both, from a row to one of its half shell.
struct Step {
  int y;
  int z;
};
constexpr Step kHalfShell[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};

/// One thread's work on one level: its spheres among themselves, or against those of others.
template <PairTest test>
class LevelTester {
 public:
  LevelTester(Workspace& w, const OrderedSpheres& spheres, const OrderedSpheres& others, int level)
      : o_(spheres),
        others_(others),
        ids_(spheres.column_ids),
        level_(w.plan.levels.level[level]),
        grid_(level_.grid),
        rows_(o_.rows.data() + o_.level_rows[level], o_.rows.data() + o_.level_rows[level + 1]),
        limit_(w.plan.candidate_limit),
        hits_(w, spheres, others) {}

  [[nodiscard]] std::uint64_t candidates() const { return candidates_; }

  /// Spheres [begin, end) of the level against those of their row and of its half shell.
  void sweep(std::uint32_t begin, std::uint32_t end) {
    std::array<RowCursor, std::size(kHalfShell)> cursors = {rows_, rows_, rows_, rows_};
    for (const Row* row = rows_.row_of(begin); row != rows_.end() && row->begin < end; ++row) {
      const Run all = {row->begin, (row + 1)->begin};
      const Run part = {std::max(all.begin, begin), std::min(all.end, end)};
      sweep_row(*row, part, all);
      const std::uint32_t number = row->first_id - level_.first_id;
      const std::uint32_t z = number / grid_.stride_z;
      const std::uint32_t y = (number - z * grid_.stride_z) / grid_.stride_y;
      for (std::size_t k = 0;
           OCTOCELL_FAULT(shell_row_missing, k + 1 < cursors.size(), k < cursors.size()); ++k) {
        const auto there_y = step_along(grid_, 1, y, kHalfShell[k].y);
        const auto there_z = step_along(grid_, 2, z, kHalfShell[k].z);
        if (!there_y || !there_z) continue;
        const std::uint32_t id =
            level_.first_id + *there_y * grid_.stride_y + *there_z * grid_.stride_z;
        const Run there = cursors[k].run_at(id);
        if (!there.empty()) sweep_rows(*row, part, id, there);
      }
    }
  }

  /// One of the others, which is of another level, against what its box holds of this one.
  void test_box(std::uint32_t sphere) {
    const Sphere s = others_.at(sphere);
    const float reach = std::nextafter(s.r + level_.r_max, HUGE_VALF);
    const CellRange box = cells_met(grid_, s, reach);
    for_each_z(box, [&](std::uint64_t first_id, std::uint64_t last_id) {
      const Row* row = rows_.not_before(first_id);
      for (; row != rows_.end() && row->first_id <= last_id; ++row) {
        test_one(sphere, columns_in(*row, box.lowest.x, box.highest.x));
      }
      return row;
    });
  }

 private:
  using Neighbours = Lanes<test, kLanes>;

  /// Spheres of a row, as many as there are lanes, and the columns that they are in.
  struct Group {
    std::uint32_t begin;
    std::uint32_t size;
    std::uint32_t first_column;
    std::uint32_t last_column;
  };
  Group group_at(const Row& row, std::uint32_t begin, std::uint32_t end) const {
    const std::uint32_t size = std::min(kLanes, end - begin);
    return {begin, size, ids_[begin] - row.first_id, ids_[begin + size - 1] - row.first_id};
  }

  /// Where x wraps, partners of the first columns lie in the last, too.
  [[nodiscard]] bool wraps_down(const Group& g) const {
    return OCTOCELL_FAULT(shell_seam_not_crossed, false,
                          grid_.wraps(0) && g.first_column < level_.reach);
  }
  [[nodiscard]] bool wraps_up(const Group& g) const {
    return grid_.wraps(0) && g.last_column + level_.reach >= grid_.period(0);
  }
  /// The last column that spheres of the group have partners in, but for wrapping.
  [[nodiscard]] std::uint32_t last_near(const Group& g) const {
    return std::min(g.last_column + level_.reach, grid_.period(0) - 1);
  }

  /// A row against itself: each sphere against those behind it.
  void sweep_row(const Row& row, Run part, Run all) {
    std::uint32_t near_end = part.begin;
    for (std::uint32_t i = part.begin; i < part.end && candidates_ <= limit_; i += kLanes) {
      const Group g = group_at(row, i, part.end);
      near_end = first_above(ids_, near_end, row.first_id + last_near(g));
      test_behind(g, wraps_down(g) ? all.end : near_end);
    }
  }

  /// A part of a row against another row.
  void sweep_rows(const Row& row, Run part, std::uint32_t other_id, Run other) {
    Run near = {other.begin, other.begin};
    for (std::uint32_t i = part.begin; i < part.end && candidates_ <= limit_; i += kLanes) {
      const Group g = group_at(row, i, part.end);
      if (wraps_down(g) || wraps_up(g)) {
        test_group(g, other);
        continue;
      }
      if (g.first_column > level_.reach) {
        const std::uint32_t first_near = g.first_column - level_.reach;
        near.begin = first_above(ids_, near.begin, other_id + first_near - 1);
      }
      near.end = first_above(ids_, std::max(near.begin, near.end), other_id + last_near(g));
      test_group(g, near);
    }
  }

  /// Sixteen from there on, of this row or not: who asks knows how many are.
  Neighbours lanes_at(std::uint32_t begin) const { return Neighbours(o_.fields<test>(), begin); }

  /// Each sphere of the group against those behind it, as far as `end`.
  void test_behind(const Group& g, std::uint32_t end) {
    const Neighbours lanes = lanes_at(g.begin);
    const std::uint32_t inside = std::min(g.begin + g.size, end);
    candidates_ += std::uint64_t{g.size} * (g.size - 1) / 2 + g.size * (end - inside);
    hits_.find_behind(g.begin, lanes, {g.begin + 1, inside});
    hits_.find(g.begin, g.size, lanes, {inside, end});
  }
  void test_group(const Group& g, Run others) {
    candidates_ += std::uint64_t{g.size} * (others.end - others.begin);
    hits_.find(g.begin, g.size, lanes_at(g.begin), others);
  }

  /// One sphere, which is not of the run, against the run.
  void test_one(std::uint32_t sphere, Run run) {
    if (candidates_ > limit_) return;
    candidates_ += run.end - run.begin;
    for (std::uint32_t j = run.begin; j < run.end; j += kLanes) {
      const LaneBits found = lanes_at(j).may_overlap(others_.fields<test>(), sphere);
      hits_.add(j, static_cast<LaneBits>(found & first_bits(run.end - j)), sphere);
    }
  }

  /// The spheres of a row in columns first..last of the unwrapped axis.
  Run columns_in(const Row& row, std::uint32_t first, std::uint32_t last) const {
    const Run all = {row.begin, (&row + 1)->begin};
    const std::uint32_t period = grid_.period(0);
    if (grid_.wraps(0) && (last - first >= period || first / period != last / period)) return all;
    const auto place = [&](std::uint64_t id) {
      return static_cast<std::uint32_t>(std::lower_bound(ids_ + all.begin, ids_ + all.end, id) -
                                        ids_);
    };
    const std::uint64_t row_id = row.first_id;
    return {place(row_id + first % period), place(row_id + last % period + 1)};
  }

  /// Calls test_rows(first id, last id) for the rows of each z that the box meets. It returns the
  /// row behind them, so that layers without a row are skipped, not visited.
  template <typename TestRows>
  void for_each_z(const CellRange& box, const TestRows& test_rows) {
    const auto [y_parts, y_count] = periods(1, box.lowest.y, box.highest.y);
    const auto [z_parts, z_count] = periods(2, box.lowest.z, box.highest.z);
    for (int zp = 0; zp < z_count; ++zp) {
      for (std::uint64_t z = z_parts[zp].begin; z < z_parts[zp].end;) {
        std::uint64_t next_z = z + 1;
        const std::uint64_t layer = level_.first_id + z * grid_.stride_z;
        for (int yp = 0; yp < y_count; ++yp) {
          const Row* const behind =
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

  /// Cells low..high of an axis that may wrap, as at most two runs of cells that have ids.
  std::pair<std::array<Run, 2>, int> periods(int axis, std::uint32_t low,
                                             std::uint32_t high) const {
    const std::uint32_t period = grid_.period(axis);
    if (high - low >= period) return {{Run{0, period}}, 1};
    const std::uint32_t first = low & grid_.wrap_mask[axis];
    const std::uint32_t last = high & grid_.wrap_mask[axis];
    if (first <= last) return {{Run{first, last + 1}}, 1};
    return {{Run{0, last + 1}, Run{first, period}}, 2};
  }

  const OrderedSpheres& o_;
  const OrderedSpheres& others_;  // as a rule the same
  const std::uint32_t* const ids_;
  const Level& level_;
  const Grid& grid_;
  RowCursor rows_;
  const std::uint64_t limit_;
  Hits<test> hits_;
  std::uint64_t candidates_ = 0;
};

/// Calls work(begin, end) for blocks of the spheres; it returns the candidates that it met. No more
/// blocks once there are too many.
template <typename Work>
void for_spheres(Workspace& w, Run spheres, std::uint64_t block,
                 std::atomic<std::uint64_t>& candidates, const Work& work) {
  w.threads->for_blocks(
      spheres.end - spheres.begin, block, [&](std::uint64_t begin, std::uint64_t end) {
        if (candidates.load(std::memory_order_relaxed) > w.plan.candidate_limit) return;
        candidates.fetch_add(work(spheres.begin + static_cast<std::uint32_t>(begin),
                                  spheres.begin + static_cast<std::uint32_t>(end)),
                             std::memory_order_relaxed);
      });
}

Run spheres_of(const OrderedSpheres& o, int level) {
  return {o.rows[o.level_rows[level]].begin, o.rows[o.level_rows[level + 1]].begin};
}

/// Those of `others` that are of one level against the spheres of another.
template <PairTest test>
void test_boxes(Workspace& w, const OrderedSpheres& spheres, int level,
                const OrderedSpheres& others, int level_of_others,
                std::atomic<std::uint64_t>& candidates) {
  for_spheres(w, spheres_of(others, level_of_others), kBoxesPerBlock, candidates,
              [&](std::uint32_t begin, std::uint32_t end) {
                LevelTester<test> tester(w, spheres, others, level);
                for (std::uint32_t s = begin; s < end; ++s) tester.test_box(s);
                return tester.candidates();
              });
}

template <PairTest test>
std::uint64_t test_all(Workspace& w, const OrderedSpheres& spheres) {
  std::atomic<std::uint64_t> candidates = 0;
  for (int level = 0; level < w.plan.levels.count; ++level) {
    for_spheres(w, spheres_of(spheres, level), kSweptPerBlock, candidates,
                [&](std::uint32_t begin, std::uint32_t end) {
                  LevelTester<test> tester(w, spheres, spheres, level);
                  tester.sweep(begin, end);
                  return tester.candidates();
                });
    for (int coarser = level + 1; coarser < w.plan.levels.count; ++coarser) {
      test_boxes<test>(w, spheres, level, spheres, coarser, candidates);
    }
  }
  return candidates.load();
}

template <PairTest test>
std::uint64_t test_against(Workspace& w, const OrderedSpheres& spheres,
                           const OrderedSpheres& others) {
  std::atomic<std::uint64_t> candidates = 0;
  for (int level = 0; level < w.plan.levels.count; ++level) {
    for_spheres(w, spheres_of(others, level), kSweptPerBlock, candidates,
                [&](std::uint32_t begin, std::uint32_t end) {
                  OtherRows<test> tester(w, spheres, others, level);
                  tester.sweep(begin, end);
                  return tester.candidates();
                });
    for (int other = 0; other < w.plan.levels.count; ++other) {
      if (other != level) test_boxes<test>(w, spheres, level, others, other, candidates);
    }
  }
  return candidates.load();
}

}  // namespace

void pair_tests(Workspace& w) {
  if (w.id_count == 0) return;
  w.candidates = test_among(w, w.ordered);
}

std::uint64_t test_among(Workspace& w, const OrderedSpheres& spheres) {
  return with_pair_test(w.plan.test, [&]<PairTest test>() { return test_all<test>(w, spheres); });
}

std::uint64_t test_between(Workspace& w, const OrderedSpheres& spheres,
                           const OrderedSpheres& others) {
  return with_band_test(w.plan.test,
                        [&]<PairTest test>() { return test_against<test>(w, spheres, others); });
}

}  // namespace octocell::cpu::half_shell
