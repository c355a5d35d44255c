// SPDX-License-Identifier: MIT
// The six stages of impl_cpu, and the data that they pass on.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/chapter32.hpp"
#include "core/finder.hpp"
#include "core/object_word.hpp"
#include "core/plan.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/ordered_spheres.hpp"
#include "impl_cpu/pair_list.hpp"
#include "impl_cpu/shared_list.hpp"
#include "impl_cpu/threads.hpp"

namespace octocell::cpu {

/// Stage 5 works on tiles of this many spheres; threads share the work of cells with more.
inline constexpr std::size_t kTileSpheres = block_size(1024, 16);

/// Cell ids with their objects. A sort moves them between two of these.
struct IdArrays {
  Buffer<std::uint32_t> cell_ids;
  Buffer<Object> objects;
  void allocate(std::uint64_t capacity) {
    cell_ids.allocate(capacity + OrderedSpheres::kMargin);
    objects.allocate(capacity);
  }
};

/// All data that the stages share. upload() allocates it as the plan says; the stages allocate
/// nothing.
struct Workspace {
  Plan plan;
  SceneView scene;
  std::shared_ptr<Threads> threads;  // shared with the workspaces of parts of a scene

  IdArrays ids[2];             // [plan.capacity.ids]
  int current = 0;             // which of the two arrays holds the ids now
  std::uint64_t id_count = 0;  // ids needed; if more than the capacity, none is valid
  Buffer<chapter32::ControlBits> control_bits;  // [spheres], rule chapter32 only
  SharedList<CellEntry> cells;
  SharedList<std::uint32_t> crowded_cells;   // indices into cells: too large for one tile
  OrderedSpheres ordered;                    // method half_shell only
  std::vector<std::uint64_t> rows_of_block;  // stage 4 of half_shell: how many rows each block
                                             // listed
  SharedList<Pair> uncertain_pairs;  // a count_only plan only counts them: see resolve_block()
  PairList pairs;

  PlanFacts facts;  // of the scene, as measured by the last stage 1
  std::uint64_t candidates = 0;
  Skips used;  // the skips, among those that depend on the data, that this run took
  std::optional<std::string> violation;
  RunRecord* record = nullptr;  // null: the run is not recorded

  /// Allocates what the plan says.
  void allocate();

  /// Clears the results of the last run; called before each run.
  void forget_last_run() {
    violation.reset();
    candidates = 0;
    used = {};
  }

  [[nodiscard]] bool ids_complete() const { return id_count <= plan.capacity.ids; }
  /// Returns true if the results of the stages so far are valid and complete.
  [[nodiscard]] bool may_test_pairs() const {
    return !violation && ids_complete() && cells.complete() && candidates <= plan.candidate_limit;
  }
};

/// Returns the bytes that Workspace::allocate() reserves and a run writes, with those that frames
/// keep.
HostBytes bytes_of(const Plan& plan, std::uint64_t spheres);

void bounds(Workspace& w);
void cell_ids(Workspace& w);
void sort(Workspace& w);
void cell_index(Workspace& w);
void pair_tests(Workspace& w);
void resolve(Workspace& w);

/// Copies what a stage has written into the record.
void write_down(const Workspace& w, Stage stage, RunRecord& record);

/// Decides a few uncertain pairs at once. A count_only plan must not need memory in proportion to
/// its pairs. So its stage 5 calls this for each full block instead of storing it for stage 6.
void resolve_block(Workspace& w, std::span<const Pair> uncertain_pairs);

}  // namespace octocell::cpu
