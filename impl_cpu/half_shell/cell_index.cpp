// SPDX-License-Identifier: MIT
// Stage 4 of half_shell: puts the spheres in the order of their columns, and finds the rows.
// Reads sorted ids, spheres. Writes ordered spheres and rows.
// Cost: one sphere gathered and 16 bytes written each, 12 if all radii are equal. Only this gather
//       is random access.
// Idea: stage 5 then reads sequentially. A row ends where an id leaves its columns, so most spheres
//       cost one comparison; a division finds the columns of the next row.
#include <algorithm>
#include <cstdint>

#include "impl_cpu/half_shell/half_shell.hpp"

namespace octocell::cpu::half_shell {
namespace {

constexpr std::uint64_t kPrefetchAhead = 128;  // with a quarter of that, the loop waits for memory

template <PairTest test>
void gather(Workspace& w, std::uint64_t begin, std::uint64_t end) {
  const Object* const order = w.ids[w.current].objects.data();
  const Sphere* const spheres = w.scene.spheres.data();
  const std::uint64_t last = w.id_count - 1;
  for (std::uint64_t k = begin; k < end; ++k) {
    __builtin_prefetch(&spheres[order[std::min(k + kPrefetchAhead, last)]]);
    w.ordered.put<test>(k, spheres[order[k]], w.plan.packing);
  }
}

/// Finds the rows that the ids of a block belong to.
class RowFinder {
 public:
  explicit RowFinder(const Levels& levels) : levels_(levels) {}

  /// Returns the id of column 0 of the row that holds `id`. Call it with increasing ids.
  std::uint32_t first_id_of_row(std::uint32_t id) {
    while (level_ + 1 < levels_.count && id >= levels_.level[level_ + 1].first_id) ++level_;
    const Level& level = levels_.level[level_];
    columns_ = level.grid.stride_y;
    return id - (id - level.first_id) % columns_;
  }
  /// Returns the number of columns of the row returned last.
  [[nodiscard]] std::uint32_t columns() const { return columns_; }

 private:
  const Levels& levels_;
  int level_ = 0;
  std::uint32_t columns_ = 1;
};

/// Writes the rows that begin in [begin, end). Returns how many.
std::uint64_t list_rows(const Workspace& w, std::uint64_t begin, std::uint64_t end,
                        ColumnRow* rows) {
  const std::uint32_t* const ids = w.ids[w.current].cell_ids.data();
  RowFinder finder(w.plan.levels);
  std::uint64_t listed = 0;
  std::uint32_t row = finder.first_id_of_row(ids[begin]);
  std::uint64_t row_end = std::uint64_t{row} + finder.columns();
  if (begin == 0 || ids[begin - 1] < row) {
    rows[listed++] = {row, static_cast<std::uint32_t>(begin)};
  }
  for (std::uint64_t k = begin + 1; k < end; ++k) {
    if (ids[k] < row_end) continue;
    row = finder.first_id_of_row(ids[k]);
    row_end = std::uint64_t{row} + finder.columns();
    rows[listed++] = {row, static_cast<std::uint32_t>(k)};
  }
  return listed;
}

/// Closes the gaps between the rows of the blocks, and marks the end of the last row.
void join_rows(Workspace& w, const IndexBlocks& blocks) {
  OrderedSpheres& o = w.ordered;
  std::uint64_t count = 0;
  for (std::uint64_t block = 0; block < blocks.count; ++block) {
    const ColumnRow* const rows = o.rows.data() + block * blocks.rows_of_each;
    std::copy(rows, rows + w.rows_of_block[block], o.rows.data() + count);
    count += w.rows_of_block[block];
  }
  o.rows[count] = {~0U, static_cast<std::uint32_t>(w.id_count)};
  const Levels& levels = w.plan.levels;
  o.level_rows[0] = 0;
  for (int level = 1; level <= levels.count; ++level) {
    const std::uint32_t next = level < levels.count ? levels.level[level].first_id : ~0U;
    o.level_rows[level] =
        static_cast<std::uint32_t>(std::ranges::lower_bound(o.rows.data(), o.rows.data() + count,
                                                            next, {}, &ColumnRow::first_id) -
                                   o.rows.data());
  }
  o.row_count = count;
}

}  // namespace

IndexBlocks::IndexBlocks(std::uint64_t spheres, const Levels& levels)
    : count((spheres + kSpheres - 1) / kSpheres), rows_of_each(0) {
  for (int k = 0; k < levels.count; ++k) {
    const Level& level = levels.level[k];
    rows_of_each += (level.ids + level.grid.stride_y - 1) / level.grid.stride_y;
  }
  rows_of_each = std::min(rows_of_each, kSpheres);
}

void cell_index(Workspace& w) {
  if (w.id_count == 0) return;
  OrderedSpheres& o = w.ordered;
  std::uint32_t* const column_ids = w.ids[w.current].cell_ids.data();
  o.column_ids = column_ids;
  o.sphere = w.ids[w.current].objects.data();
  const IndexBlocks blocks(w.id_count, w.plan.levels);
  const auto per_block = [&](std::uint64_t begin, std::uint64_t end) {
    with_pair_test(w.plan.test, [&]<PairTest test>() { gather<test>(w, begin, end); });
    const std::uint64_t block = begin / IndexBlocks::kSpheres;
    w.rows_of_block[block] = list_rows(w, begin, end, o.rows.data() + block * blocks.rows_of_each);
  };
  w.threads->for_blocks(w.id_count, IndexBlocks::kSpheres, per_block);
  for (std::uint64_t k = 0; k < OrderedSpheres::kMargin; ++k) {
    column_ids[w.id_count + k] = ~0U;
  }
  o.pad(w.id_count);
  join_rows(w, blocks);
}

}  // namespace octocell::cpu::half_shell
