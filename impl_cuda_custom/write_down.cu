// SPDX-License-Identifier: MIT
// Copies of what the stages have written, for a run that is recorded.
#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/cuda/cuda.cuh"
#include "core/not_recorded.hpp"
#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom {
namespace {

template <typename T>
std::vector<T> copy_of(const Workspace& w, const T* items, std::uint64_t count) {
  std::vector<T> copy(count);
  if (count != 0) {
    cuda::check(
        cudaMemcpyAsync(copy.data(), items, count * sizeof(T), cudaMemcpyDeviceToHost, w.stream));
  }
  cuda::check(cudaStreamSynchronize(w.stream));
  return copy;
}

void copy_ids(const Workspace& w, const State& state, KeysAndValues from, RecordedIds& to) {
  to.cell_ids.set(copy_of(w, from.keys, state.entries));
  to.objects.set(copy_of(w, from.values, state.entries));
}

/// Makes room for all candidates of the pair tests; if they are too many, there will be no tests.
void open_considered(Workspace& w, std::uint64_t candidates) {
  if (candidates > w.plan.candidate_limit) candidates = 0;
  w.considered.allocate(candidates);
  w.considered_count.allocate(1);
  cuda::check(cudaMemsetAsync(w.considered_count.data(), 0, sizeof(std::uint64_t), w.stream));
}

/// Threads wrote them in an order that changes from run to run.
std::vector<Considered> in_order(std::vector<Considered> found) {
  const auto key = [](const Considered& c) { return std::tuple(c.cell_id, c.i, c.j); };
  std::sort(found.begin(), found.end(),
            [&](const Considered& a, const Considered& b) { return key(a) < key(b); });
  return found;
}

/// Method tiles leaves out stages 2 to 4 as others know them.
void lack_ids(RunRecord& record) {
  for (RecordedIds* ids : {&record.ids, &record.sorted}) {
    ids->cell_ids.lack(not_recorded::kTilesInstead);
    ids->objects.lack(not_recorded::kTilesInstead);
  }
  record.passes.lack(not_recorded::kTilesInstead);
  record.cells.lack(not_recorded::kTilesInstead);
  record.rows.lack(not_recorded::kTilesInstead);
  record.control_bits.lack(not_recorded::kNoControlBits);
}

void copy_index(Workspace& w, const State& state, RunRecord& record) {
  record.cells.lack("the sorted ids are the index: no list of cells is made");
  record.rows.lack("the sorted ids are the index: no list of rows is made");
  if (!w.half_shell()) open_considered(w, state.candidates);
}

void copy_pairs(Workspace& w, const State& state, RunRecord& record) {
  const Capacities& room = w.plan.capacity;
  if (state.pairs <= room.pairs) record.certain.set(copy_of(w, w.pairs.data(), state.pairs));
  if (state.uncertain_pairs <= room.uncertain_pairs) {
    record.uncertain.set(copy_of(w, w.uncertain_pairs.data(), state.uncertain_pairs));
  }
  if (w.half_shell() || w.tiles()) {
    record.considered.lack(not_recorded::kNoCandidates);
  } else {
    const std::uint64_t count = copy_of(w, w.considered_count.data(), 1).front();
    record.considered.set(in_order(copy_of(w, w.considered.data(), count)));
  }
}

}  // namespace

void write_down(Workspace& w, Stage stage, RunRecord& record) {
  if (w.sphere_count() == 0) return;
  const State state = copy_of(w, w.state.data(), 1).front();
  if (state.violations != 0) return;
  if (stage == Stage::bounds && w.brute_force()) {
    open_considered(w, w.sphere_count() * (w.sphere_count() - 1) / 2);
  }
  if (stage == Stage::cell_ids && w.tiles()) return lack_ids(record);
  if (stage == Stage::cell_ids) {
    copy_ids(w, state, w.side(0), record.ids);
    if (w.plan.rule == Rule::chapter32) {
      record.control_bits.set(copy_of(w, w.control_bits.data(), w.sphere_count()));
    } else {
      record.control_bits.lack(not_recorded::kNoControlBits);
    }
  }
  if (stage == Stage::sort) {
    copy_ids(w, state, w.sorted(), record.sorted);
    const bool sorted = !w.half_shell() || state.out_of_order != 0;
    record.passes.exists = sorted;
    if (!sorted) record.passes.lack(not_recorded::kInOrder);
  }
  if (stage == Stage::cell_index) copy_index(w, state, record);
  if (stage == Stage::pair_tests) copy_pairs(w, state, record);
}

}  // namespace octocell::cuda_custom
