// SPDX-License-Identifier: MIT
// The six stages of impl_cpu, and what they hand on.
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

/// Stage 5 works on tiles of this many spheres; cells with more are shared out among the threads.
inline constexpr std::size_t kTileSpheres = block_size(1024, 16);

/// Cell ids with their objects. Sorting moves them between two of these.
struct IdArrays {
  Buffer<std::uint32_t> cell_ids;
  Buffer<Object> objects;
  void allocate(std::uint64_t capacity) {
    cell_ids.allocate(capacity + OrderedSpheres::kMargin);
    objects.allocate(capacity);
  }
};

/// Everything the stages share. Sized by the plan in upload(); the stages allocate nothing.
struct Workspace {
  Plan plan;
  SceneView scene;
  std::shared_ptr<Threads> threads;  // workspaces of parts of a scene share them

  IdArrays ids[2];                              // [plan.capacity.ids]
  int current = 0;                              // which of the two holds the ids now
  std::uint64_t id_count = 0;                   // ids needed; more than the capacity: none is valid
  Buffer<chapter32::ControlBits> control_bits;  // [spheres], rule chapter32 only
  SharedList<CellEntry> cells;
  SharedList<std::uint32_t> crowded_cells;   // indices into cells: too large for one tile
  OrderedSpheres ordered;                    // method half_shell only
  std::vector<std::uint64_t> rows_of_block;  // of its stage 4: how many each block listed
  SharedList<Pair> uncertain_pairs;          // in a count_only plan only counted: see resolve()
  PairList pairs;

  PlanFacts facts;  // of the scene, as stage 1 has seen it last
  std::uint64_t candidates = 0;
  Skips used;  // of those that only the data can allow
  std::optional<std::string> violation;

  /// Room for what the plan says.
  void allocate();

  /// Before each run.
  void forget_last_run() {
    violation.reset();
    candidates = 0;
    used = {};
  }

  [[nodiscard]] bool ids_complete() const { return id_count <= plan.capacity.ids; }
  /// Whether later stages have something sound to work on.
  [[nodiscard]] bool may_test_pairs() const {
    return !violation && ids_complete() && cells.complete() && candidates <= plan.candidate_limit;
  }
};

/// What Workspace::allocate() makes room for and a run writes to, and what frames keep besides.
HostBytes bytes_of(const Plan& plan, std::uint64_t spheres);

/// Whether these facts are at least as strong as those of a plan.
bool are_within(const PlanFacts& seen, const PlanFacts& planned);

void bounds(Workspace& w);
void cell_ids(Workspace& w);
void sort(Workspace& w);
void cell_index(Workspace& w);
void pair_tests(Workspace& w);
void resolve(Workspace& w);

/// Decides a few uncertain pairs at once. A count_only plan, which must not need memory in
/// proportion to its pairs, has stage 5 call this for each full block instead of storing it for
/// stage 6.
void resolve_block(Workspace& w, std::span<const Pair> uncertain_pairs);

}  // namespace octocell::cpu
