// SPDX-License-Identifier: MIT
// Stage 4 of half_shell: puts the spheres in the order of their columns, and finds the rows.
// Reads sorted ids, spheres. Writes members in that order, rows; the number of candidates.
// Cost: one sphere gathered each; its windows are found here, and in stage 5 again.
// Idea: the columns of a row have consecutive ids, so copy_if keeps the positions where the row
//       changes, and only rows that hold spheres are listed. A reduction over the windows counts
//       the candidates before any is tested.
#include <thrust/copy.h>
#include <thrust/fill.h>
#include <thrust/functional.h>
#include <thrust/transform.h>
#include <thrust/transform_reduce.h>

#include <cstdint>

#include "impl_thrust/gather.cuh"
#include "impl_thrust/half_shell/shell.cuh"

namespace octocell::on_thrust::half_shell {
namespace {

/// Returns the id of column 0 of the row that holds `id`.
OCTOCELL_HD std::uint32_t first_id_of_row(const Levels& levels, std::uint32_t id) {
  const Level& level = levels.level[level_of_id(levels, id)];
  return id - (id - level.first_id) % level.grid.stride_y;
}

struct BeginsRow {
  const Levels* levels;
  const std::uint32_t* ids;
  OCTOCELL_HD bool operator()(std::uint64_t k) const {
    return k == 0 || ids[k - 1] < first_id_of_row(*levels, ids[k]);
  }
};

struct RowAt {
  const Levels* levels;
  const std::uint32_t* ids;
  OCTOCELL_HD ColumnRow operator()(std::uint32_t begin) const {
    return {first_id_of_row(*levels, ids[begin]), begin};
  }
};

struct CandidatesOf {
  Shell shell;
  OCTOCELL_HD std::uint64_t operator()(std::uint64_t k) const {
    std::uint64_t sum = 0;
    shell.for_each_run(static_cast<std::uint32_t>(k), [&](IndexRange run) { sum += run.size(); });
    return sum;
  }
};

}  // namespace

template <typename System>
void cell_index(Workspace<System>& w) {
  const std::uint32_t* const ids = w.cell_ids.data();
  std::uint32_t* const begins = w.cell_begins.data();
  const std::uint32_t* const last = thrust::copy_if(
      w.system.policy(), Positions(0), Positions(w.id_count), begins, BeginsRow{w.levels, ids});
  w.cell_count = static_cast<std::uint64_t>(last - begins);
  if (!w.may_test_pairs()) return;
  ColumnRow* const rows_end = thrust::transform(w.system.policy(), begins, begins + w.cell_count,
                                                w.rows.data(), RowAt{w.levels, ids});
  thrust::fill_n(w.system.policy(), rows_end, 1,
                 ColumnRow{~0U, static_cast<std::uint32_t>(w.id_count)});
  gather_members(w);
  w.candidates = thrust::transform_reduce(w.system.policy(), Positions(0), Positions(w.id_count),
                                          CandidatesOf{shell_of(w)}, std::uint64_t{0},
                                          thrust::plus<std::uint64_t>{});
}

OCTOCELL_FOR_BOTH_SYSTEMS(cell_index);

}  // namespace octocell::on_thrust::half_shell
