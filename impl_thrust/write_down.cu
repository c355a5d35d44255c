// SPDX-License-Identifier: MIT
// Copies of what the stages have written, for a run that is recorded.
#include <cstdint>
#include <string_view>

#include "core/not_recorded.hpp"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {
namespace {

template <typename System>
void copy_ids(Workspace<System>& w, RecordedIds& to) {
  to.cell_ids.set(w.system.read(w.cell_ids.data(), w.id_count));
  to.objects.set(w.system.read(w.objects.data(), w.id_count));
}

template <typename System>
void copy_index(Workspace<System>& w, RunRecord& record) {
  if (w.half_shell()) {
    record.rows.set(w.system.read(w.rows.data(), w.cell_count));
    record.cells.lack(not_recorded::kRowsInstead);
  } else {
    record.cells.set(w.system.read(w.cells.data(), w.cell_count));
    record.rows.lack(not_recorded::kNoRows);
  }
}

template <typename System>
void copy_pairs(Workspace<System>& w, RunRecord& record) {
  if (w.pairs_complete()) record.certain.set(w.system.read(w.pairs.data(), w.sure_count));
  if (w.uncertain_pairs_complete()) {
    record.uncertain.set(w.system.read(w.uncertain_pairs.data(), w.uncertain_count));
  }
  if (w.half_shell()) record.considered.lack(not_recorded::kNoCandidates);
}

}  // namespace

template <typename System>
void write_down(Workspace<System>& w, Stage stage, RunRecord& record) {
  if (w.violation || !w.ids_complete()) return;
  if (stage == Stage::cell_ids) {
    copy_ids(w, record.ids);
    if (w.plan.rule == Rule::chapter32) {
      record.control_bits.set(w.system.read(w.control_bits.data(), w.sphere_count()));
    } else {
      record.control_bits.lack(not_recorded::kNoControlBits);
    }
  }
  if (stage == Stage::sort) {
    copy_ids(w, record.sorted);
    record.passes.lack(
        w.used.has(Skip::sort)
            ? not_recorded::kInOrder
            : std::string_view("Thrust sorts in one call, which does not show its passes"));
  }
  if (stage == Stage::cell_index) copy_index(w, record);
  if (stage == Stage::pair_tests) copy_pairs(w, record);
}

OCTOCELL_FOR_BOTH_SYSTEMS(write_down, Stage stage, RunRecord& record);

}  // namespace octocell::on_thrust
