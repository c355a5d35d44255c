// SPDX-License-Identifier: MIT
// Stage 4, cell_index: where does each cell begin, and how many homes and phantoms does it have?
// Reads sorted cell ids and objects. Writes one entry for each cell in which a pair can be tested.
// Cost: 8 bytes an id.
// Idea: a cell begins where the id changes. Cells with nothing to test are left out here, once.
#include <atomic>
#include <cstdint>

#include "core/pair_rule.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"

namespace octocell::cpu {
namespace {

constexpr std::uint64_t kIdsPerBlock = block_size(1 << 16, 16);
using CellWriter = ListWriter<CellEntry, kListBlock>;

struct SortedIds {
  const std::uint32_t* cell_ids;
  const Object* objects;
  std::uint64_t count;

  [[nodiscard]] bool begins_cell(std::uint64_t i) const {
    return i == 0 || cell_ids[i] != cell_ids[i - 1];
  }
  [[nodiscard]] CellEntry cell_at(std::uint64_t begin) const {
    std::uint64_t end = begin;
    std::uint32_t homes = 0;
    do {
      homes += (objects[end] & kPhantom) == 0 ? 1U : 0U;
      ++end;
    } while (end < count && cell_ids[end] == cell_ids[begin]);
    const auto members = static_cast<std::uint32_t>(end - begin);
    return {static_cast<std::uint32_t>(begin), homes, members - homes};
  }
};

}  // namespace

void cell_index(Workspace& w) {
  w.cells.clear();
  if (w.violation || !w.ids_complete()) return;
  if (w.plan.method == Method::half_shell) return half_shell::cell_index(w);
  const IdArrays& ids = w.ids[w.current];
  const SortedIds sorted = {ids.cell_ids.data(), ids.objects.data(), w.id_count};
  std::atomic<std::uint64_t> candidates = 0;
  w.threads->for_blocks(w.id_count, kIdsPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
    CellWriter cells(w.cells);
    std::uint64_t seen = 0;
    std::uint64_t i = begin;
    while (i < end && !sorted.begins_cell(i)) ++i;  // the previous block handles that cell
    while (i < end) {
      const CellEntry cell = sorted.cell_at(i);
      const std::uint64_t here = candidates_in_cell(w.plan.rule, cell.homes, cell.phantoms);
      if (here != 0) cells.push(cell);
      seen += here;
      i += cell.homes + cell.phantoms;
    }
    candidates.fetch_add(seen, std::memory_order_relaxed);
  });
  w.candidates = candidates.load();
}

}  // namespace octocell::cpu
