// SPDX-License-Identifier: MIT
// Copies of what the stages have written, for a run that is recorded.
#include <cstdint>
#include <span>
#include <vector>

#include "core/not_recorded.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {
namespace {

template <typename T>
std::vector<T> copy_of(const T* items, std::uint64_t count) {
  return {items, items + count};
}

template <typename T>
std::vector<T> copy_of(std::span<const T> items) {
  return {items.begin(), items.end()};
}

void copy_ids(const Workspace& w, RecordedIds& to) {
  const IdArrays& ids = w.ids[w.current];
  to.cell_ids.set(copy_of(ids.cell_ids.data(), w.id_count));
  to.objects.set(copy_of(ids.objects.data(), w.id_count));
}

void note_passes(const Workspace& w, RunRecord& record) {
  record.passes.exists = !w.used.has(Skip::sort);
  if (!record.passes.exists) record.passes.lack(not_recorded::kInOrder);
}

void copy_index(const Workspace& w, RunRecord& record) {
  if (w.plan.method == Method::half_shell) {
    record.rows.set(copy_of(w.ordered.rows.data(), w.ordered.row_count));
    record.cells.lack(not_recorded::kRowsInstead);
  } else {
    record.cells.set(copy_of<CellEntry>(w.cells.items()));
    record.rows.lack(not_recorded::kNoRows);
  }
}

void copy_pairs(const Workspace& w, RunRecord& record) {
  record.certain.set(copy_of<Pair>(w.pairs.items()));
  record.uncertain.set(copy_of<Pair>(w.uncertain_pairs.items()));
  record.considered.exists = w.plan.method != Method::half_shell;
  if (!record.considered.exists) {
    record.considered.lack(not_recorded::kNoCandidates);
  }
}

}  // namespace

void write_down(const Workspace& w, Stage stage, RunRecord& record) {
  if (w.violation || !w.ids_complete()) return;
  if (stage == Stage::cell_ids) {
    copy_ids(w, record.ids);
    if (w.plan.rule == Rule::chapter32) {
      record.control_bits.set(copy_of(w.control_bits.data(), w.scene.spheres.size()));
    } else {
      record.control_bits.lack(not_recorded::kNoControlBits);
    }
  }
  if (stage == Stage::sort) {
    copy_ids(w, record.sorted);
    note_passes(w, record);
  }
  if (stage == Stage::cell_index) copy_index(w, record);
  if (stage == Stage::pair_tests) copy_pairs(w, record);
}

}  // namespace octocell::cpu
