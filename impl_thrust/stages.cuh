// SPDX-License-Identifier: MIT
// The six stages of impl_thrust, and the data that they pass on.
#pragma once

#include <thrust/iterator/counting_iterator.h>

#include <cstdint>
#include <optional>
#include <string>

#include "core/chapter32.hpp"
#include "core/half_shell.hpp"
#include "core/object_word.hpp"
#include "core/pair.hpp"
#include "core/plan.hpp"
#include "core/run_record.hpp"
#include "core/stage.hpp"
#include "impl_thrust/systems.cuh"

namespace octocell::on_thrust {

/// Counts 0, 1, 2, ...: most algorithms here run over positions in the plan's arrays.
using Positions = thrust::counting_iterator<std::uint64_t>;

/// How many pairs one entry finds; after the scan, where they go.
struct Found {
  std::uint64_t sure;
  std::uint64_t uncertain_pairs;
};

/// All data that the stages share. allocate() reserves it as the plan says. The stages allocate
/// only Thrust's scratch memory, which is kept.
template <typename System>
struct Workspace {
  template <typename T>
  using Array = typename System::template Array<T>;

  System system;
  Plan plan;
  SceneView scene;                  // on the host: messages about a sphere are made from it
  const Sphere* spheres = nullptr;  // in the memory where the system computes
  const Levels* levels = nullptr;   // the plan's, in the same memory
  const Flags* flags = nullptr;     // null: every pair may collide

  Array<std::uint64_t> phantoms_before;        // [spheres + 1]
  Array<std::uint32_t> cell_ids;               // [plan.capacity.ids]
  Array<Object> objects;                       // [entries]
  Array<chapter32::ControlBits> control_bits;  // [spheres], rule chapter32 only
  Array<std::uint32_t> cell_begins;            // [plan.capacity.ids]
  Array<CellEntry> cells;                      // [plan.capacity.cells]
  Array<std::uint32_t> cell_end;  // [plan.capacity.ids] of the cell that holds the entry
  Array<Sphere> members;          // [entries] each entry's sphere, with its stored radius
  Array<ColumnRow> rows;          // [plan.capacity.cells + 1], half_shell only
  Array<Found> found;             // [entries + 1]
  Array<Pair> uncertain_pairs;    // [plan.capacity.uncertain_pairs]
  Array<Pair> pairs;              // [plan.capacity.pairs]

  // What was counted. A count above its capacity says what is needed; the array then holds nothing.
  std::uint64_t id_count = 0;
  std::uint64_t cell_count = 0;
  std::uint64_t candidates = 0;
  Skips used;  // the skips, among those that depend on the data, that this run took
  std::uint64_t uncertain_count = 0;
  std::uint64_t sure_count = 0;
  std::uint64_t pair_count = 0;
  std::uint64_t checksum = 0;  // of the pairs; only in a count_only plan
  std::optional<std::string> violation;
  RunRecord* record = nullptr;  // null: the run is not recorded

  [[nodiscard]] std::uint64_t sphere_count() const { return scene.spheres.size(); }
  [[nodiscard]] bool brute_force() const { return plan.method == Method::brute_force; }
  [[nodiscard]] bool half_shell() const { return plan.method == Method::half_shell; }
  /// Returns the number of work items of stage 5: spheres, or ids.
  [[nodiscard]] std::uint64_t entries() const { return brute_force() ? sphere_count() : id_count; }

  [[nodiscard]] bool ids_complete() const { return brute_force() || id_count <= plan.capacity.ids; }
  [[nodiscard]] bool uncertain_pairs_complete() const {
    return uncertain_count <= plan.capacity.uncertain_pairs;
  }
  [[nodiscard]] bool pairs_complete() const { return pair_count <= plan.capacity.pairs; }
  /// Returns true if the results of the stages so far are valid and complete.
  [[nodiscard]] bool may_test_pairs() const {
    return !violation && ids_complete() && cell_count <= plan.capacity.cells &&
           candidates <= plan.candidate_limit;
  }

  void allocate() {
    const Capacities& room = plan.capacity;
    const std::uint64_t most_entries = brute_force() ? sphere_count() : room.ids;
    for (auto* of_ids : {&cell_ids, &cell_begins}) of_ids->allocate(room.ids);
    objects.allocate(most_entries);
    members.allocate(most_entries);
    found.allocate(most_entries + 1);
    if (half_shell()) {
      rows.allocate(room.cells + 1);
    } else {
      if (!brute_force()) phantoms_before.allocate(sphere_count() + 1);
      if (plan.rule == Rule::chapter32) control_bits.allocate(sphere_count());
      cell_end.allocate(room.ids);
      cells.allocate(room.cells);
    }
    uncertain_pairs.allocate(room.uncertain_pairs);
    pairs.allocate(room.pairs);
  }
};

template <typename System>
void bounds(Workspace<System>& w);
template <typename System>
void cell_ids(Workspace<System>& w);
template <typename System>
void sort(Workspace<System>& w);
template <typename System>
void cell_index(Workspace<System>& w);
template <typename System>
void pair_tests(Workspace<System>& w);
template <typename System>
void resolve(Workspace<System>& w);

/// Copies what a stage has written into the record.
template <typename System>
void write_down(Workspace<System>& w, Stage stage, RunRecord& record);

}  // namespace octocell::on_thrust
