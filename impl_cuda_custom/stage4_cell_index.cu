// SPDX-License-Identifier: MIT
// Stage 4, cell_index: where does each cell begin, and how many homes and phantoms does it have?
// Reads sorted cell ids and objects. Writes the numbers of cells and candidates, and the crowded
//       tiles.
// Cost: 4 bytes an id, read once, and a few more loads of the same lines for each cell.
// Idea: the sorted ids are the index. Stage 5 reads them anyway and sees where a cell ends. It
//       cannot see that a cell extends past the next tile, so only that is stored. The end of a
//       cell and its first phantom are found by doubling and halving steps: no thread walks through
//       a cell.
#include <cstdint>

#include "core/pair_rule.hpp"
#include "impl_cuda_custom/device.cuh"
#include "impl_cuda_custom/half_shell/cell_index.cuh"

namespace octocell::cuda_custom {
namespace {

constexpr int kIdsPerThread = 8;
constexpr int kIdsPerBlock = kBlockThreads * kIdsPerThread;

/// Returns the first place behind `begin` that holds another id.
__device__ std::uint64_t end_of_cell(const std::uint32_t* cell_ids, std::uint64_t begin,
                                     std::uint64_t entries) {
  const std::uint32_t id = cell_ids[begin];
  std::uint64_t inside = begin;
  std::uint64_t step = 1;
  while (inside + step < entries && cell_ids[inside + step] == id) {
    inside += step;
    step *= 2;
  }
  std::uint64_t outside = min(inside + step, entries);
  while (outside - inside > 1) {
    const std::uint64_t middle = inside + (outside - inside) / 2;
    (cell_ids[middle] == id ? inside : outside) = middle;
  }
  return outside;
}

/// Returns the place of the cell's first phantom, or `end`; homes come first.
__device__ std::uint64_t first_phantom(const Object* objects, std::uint64_t begin,
                                       std::uint64_t end) {
  while (begin < end) {
    const std::uint64_t middle = begin + (end - begin) / 2;
    if ((objects[middle] & kPhantom) != 0) {
      end = middle;
    } else {
      begin = middle + 1;
    }
  }
  return begin;
}

struct CellIndexJob {
  const std::uint32_t* cell_ids;
  const Object* objects;
  CrowdedTile* crowded_tiles;
  State* state;
  Rule rule;

  __device__ bool begins_cell(std::uint64_t i) const {
    return i == 0 || cell_ids[i] != cell_ids[i - 1];
  }

  /// Lists the tiles with a row in [begin, rows_end) whose cell extends past the next tile.
  __device__ void list_crowded_tiles(std::uint64_t begin, std::uint64_t rows_end,
                                     std::uint64_t end) const {
    const std::uint64_t first = begin / kBlockThreads;
    std::uint64_t last = first;  // one past it
    while (last * kBlockThreads < rows_end && (last + 2) * kBlockThreads < end) ++last;
    if (last == first) return;
    std::uint64_t place = atomic_add(&state->crowded_tiles, last - first);
    for (std::uint64_t tile = first; tile < last; ++tile) {
      const std::uint64_t row_begin = max(begin, tile * kBlockThreads);
      crowded_tiles[place++] = {static_cast<std::uint32_t>(row_begin),
                                static_cast<std::uint32_t>(end)};
    }
  }

  /// Counts a cell and lists its crowded tiles. Returns its candidates.
  __device__ std::uint64_t visit_cell(std::uint64_t begin, std::uint64_t entries) const {
    const std::uint64_t end = end_of_cell(cell_ids, begin, entries);
    if (end - begin < 2) return 0;
    const std::uint64_t rows_end = rows_are_homes(rule) ? first_phantom(objects, begin, end) : end;
    const std::uint64_t candidates = candidates_in_cell(rule, rows_end - begin, end - rows_end);
    if (candidates != 0) list_crowded_tiles(begin, rows_end, end);
    return candidates;
  }
};

__global__ void __launch_bounds__(kBlockThreads) cell_index_kernel(CellIndexJob job) {
  const std::uint64_t entries = job.state->entries;
  const std::uint64_t block_begin = std::uint64_t{blockIdx.x} * kIdsPerBlock;
  if (block_begin >= entries) return;
  const std::uint64_t first = block_begin + threadIdx.x;
  std::uint64_t cells = 0;
  std::uint64_t candidates = 0;
  for (int k = 0; k < kIdsPerThread; ++k) {
    const std::uint64_t i = first + static_cast<std::uint64_t>(k) * kBlockThreads;
    if (i >= entries || !job.begins_cell(i)) continue;
    const std::uint64_t here = job.visit_cell(i, entries);
    cells += here != 0 ? 1 : 0;
    candidates += here;
  }
  add_over_block(&job.state->cells, cells);
  add_over_block(&job.state->candidates, candidates);
}

}  // namespace

void cell_index(Workspace& w) {
  if (w.plan.method == Method::half_shell) return half_shell::cell_index(w);
  if (w.sphere_count() == 0 || w.plan.capacity.ids == 0) return;
  const KeysAndValues sorted = w.sorted();
  const CellIndexJob job = {sorted.keys, sorted.values, w.crowded_tiles.data(), w.state.data(),
                            w.plan.rule};
  cell_index_kernel<<<blocks_for(w.plan.capacity.ids, kIdsPerBlock), kBlockThreads, 0, w.stream>>>(
      job);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom
