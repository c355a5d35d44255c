// SPDX-License-Identifier: MIT
// The six stages of impl_cuda_custom, and the data that they pass on. Each stage queues kernels and
// returns. What it finds is in State, on the device, where the next stage reads it.
#pragma once

#include <cuda_runtime.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "core/chapter32.hpp"
#include "core/cuda/cuda.cuh"
#include "core/object_word.hpp"
#include "core/pair.hpp"
#include "core/plan.hpp"
#include "core/plan_facts.hpp"
#include "core/run_record.hpp"
#include "core/stage.hpp"
#include "impl_cuda_custom/coherence/rules.hpp"
#include "impl_cuda_custom/pinned_array.cuh"
#include "impl_cuda_custom/radix_sort/radix_sort.cuh"

namespace octocell::cuda_custom {

/// The threads of a block, in every kernel here; also the rows and columns of a tile in stage 5.
inline constexpr int kBlockThreads = 256;

/// A bit of State::violations, beside those of core/plan_facts.hpp: rule chapter32's condition does
/// not hold.
inline constexpr std::uint32_t kThreeCells = 4;

/// What was counted so far. Counts continue past the end of a full buffer.
struct State {
  std::uint64_t ids = 0;
  std::uint64_t entries = 0;  // what stages 3 to 5 work on: all ids, or none if an earlier stage
                              // failed
  std::uint64_t wide_spheres = 0;
  std::uint64_t cells = 0;
  std::uint64_t candidates = 0;
  std::uint64_t crowded_tiles = 0;
  std::uint64_t uncertain_pairs = 0;
  std::uint64_t pairs = 0;
  std::uint64_t checksum = 0;  // of the pairs; only in a count_only plan
  std::uint32_t violations = 0;
  std::uint32_t blocks_done = 0;  // of stage 2
  FrameMode mode = FrameMode::search;
  std::uint32_t out_of_order = 0;  // half_shell's ids are unsorted, or were not checked
  std::uint32_t tile_records = 0;  // of the fullest tile, if one has more than there is room for
  std::uint32_t unused = 0;
};
static_assert(sizeof(State) == 9 * 8 + 6 * 4);

/// If a sphere meets more cells than this, many blocks write its phantoms, not one.
inline constexpr std::uint64_t kWidePhantoms = 2048;

struct WideSphere {
  std::uint32_t sphere;
  std::uint32_t place;  // of its first phantom
};

/// The rows of one tile whose cell extends past the next tile. Tiles are aligned, so each entry
/// lies in exactly one; see stage 5.
struct CrowdedTile {
  std::uint32_t row_begin;
  std::uint32_t cell_end;
};

/// Method half_shell: where the spheres of each cell begin among the sorted ones. One start serves
/// 2^shift ids, so the list is not much longer than the list of spheres.
struct StartsShape {
  std::uint32_t ids = 0;  // of all levels together
  int shift = 0;
  /// Returns the number of starts, with one for the end of the last group of ids, and one for the
  /// group that begins there.
  [[nodiscard]] std::uint32_t starts() const { return (ids >> shift) + 2; }
};
inline StartsShape starts_shape(const Levels& levels, std::uint64_t spheres) {
  constexpr std::uint64_t kMostPerSphere = 8;
  if (levels.count == 0) return {};
  const Level& last = levels.level[levels.count - 1];
  StartsShape shape = {.ids = last.first_id + last.ids};
  while (shape.ids >> shape.shift > kMostPerSphere * spheres + 1024) ++shape.shift;
  return shape;
}

/// Stage 5 of half_shell reads this many spheres behind the last one and does not use them.
inline constexpr std::uint32_t kReadBehind = 34;

/// All data that the stages share. The plan gives the sizes of the arrays; the stages allocate
/// nothing.
struct Workspace {
  Plan plan;
  SceneView scene;  // on the host: messages about a sphere are made from it
  cudaStream_t stream = nullptr;
  float growth = 0.0F;  // of each radius in this frame's search, if it has a skin (see coherence/)
  std::optional<FrameMode> mode;  // of this frame, as the host predicts or knows it; none: neither
  std::optional<RadixSort> sorter;        // for methods with a grid
  std::optional<RadixSort> grown_sorter;  // for enlarged spheres, if the plan has a skin
  RunRecord* record = nullptr;            // null: the run is not recorded

  cuda::DeviceArray<State> state;                          // [1]
  cuda::DeviceArray<Sphere> spheres;                       // [spheres]
  cuda::DeviceArray<Flags> flags;                          // [spheres], or unused: see below
  cuda::DeviceArray<std::uint32_t> ids[2];                 // both sides of the sort: see side()
  cuda::DeviceArray<WideSphere> wide_spheres;              // [plan.capacity.ids / kWidePhantoms]
  cuda::DeviceArray<char> sort_scratch;                    // as much as the sorter needs
  cuda::DeviceArray<chapter32::ControlBits> control_bits;  // [spheres], rule chapter32 only
  cuda::DeviceArray<CrowdedTile> crowded_tiles;            // [plan.capacity.ids / kBlockThreads]
  cuda::DeviceArray<Sphere> sorted_spheres;       // [spheres + kReadBehind], half_shell only
  cuda::DeviceArray<PackedSphere> sorted_packed;  // the same, packed tests only
  cuda::DeviceArray<std::uint32_t> cell_starts;   // see StartsShape
  cuda::DeviceArray<TileRecord> tile_records;     // [tiles][plan.capacity.tile_records]
  cuda::DeviceArray<std::uint32_t> tile_sizes;    // [tiles]
  cuda::DeviceArray<Pair> uncertain_pairs;        // [plan.capacity.uncertain_pairs]
  cuda::DeviceArray<Pair> pairs;                  // [plan.capacity.pairs]

  // Only for a run that is recorded; see write_down():
  cuda::DeviceArray<Considered> considered;           // [candidates]
  cuda::DeviceArray<std::uint64_t> considered_count;  // [1]

  // Kept between frames, if frames may reuse data:
  PinnedArray<FrameMode> mode_taken;                   // [1] of the last frame
  cuda::DeviceArray<coherence::FrameHistory> history;  // [1]
  cuda::DeviceArray<Sphere> sample;       // [coherence::kSampled] as they were in the last frame
  cuda::DeviceArray<Sphere> snapshot;     // [spheres] of the last frame, if that was worthwhile
  cuda::DeviceArray<Sphere> searched;     // [spheres] as they were in the last search
  cuda::DeviceArray<Pair> neighbor_list;  // [plan.capacity.pairs] of the last search

  [[nodiscard]] std::uint64_t sphere_count() const { return scene.spheres.size(); }
  [[nodiscard]] bool brute_force() const { return plan.method == Method::brute_force; }
  /// Returns the flags; null if every pair may collide.
  [[nodiscard]] const Flags* flags_or_none() const {
    return scene.flags.empty() ? nullptr : flags.data();
  }
  /// Returns true if the method is half_shell, it has something to do, and its ids fit.
  [[nodiscard]] bool half_shell() const {
    return plan.method == Method::half_shell && !plan.nothing_to_find && sphere_count() > 0 &&
           plan.levels.count > 0 && plan.capacity.ids >= sphere_count();
  }
  /// The same for method tiles. `ids` have room for half_shell, in case the tiles do not fit.
  [[nodiscard]] bool tiles() const {
    return plan.method == Method::tiles && !plan.nothing_to_find && sphere_count() > 0 &&
           plan.capacity.ids >= sphere_count();
  }
  /// Returns what a frame may reuse from the last. Plans that only count keep no pairs.
  [[nodiscard]] coherence::Allowed allowed() const {
    const bool any = plan.moving && half_shell() && !plan.count_only &&
                     sphere_count() == plan.facts.sphere_count;
    const bool has_skin = any && plan.skin.growth > 0.0F;
    return {.unchanged = any && plan.allowed.has(Skip::unchanged),
            .neighbor_list = has_skin,
            .near_room = has_skin ? plan.capacity.pairs : 0};
  }
  [[nodiscard]] bool coherent() const { return allowed().any(); }
  /// Returns true if this frame may be in that mode, as far as the host knows or predicts.
  [[nodiscard]] bool may_take(FrameMode c) const {
    if (c == FrameMode::neighbor_list && !allowed().neighbor_list) return false;
    return !mode || *mode == c;
  }
  /// Return what this frame's search uses: an enlarged radius or not, the levels, the sorter, the
  /// test.
  [[nodiscard]] bool grows() const { return growth > 0.0F; }
  [[nodiscard]] const Levels& levels() const { return grows() ? plan.skin.levels : plan.levels; }
  [[nodiscard]] const RadixSort& sorter_now() const { return grows() ? *grown_sorter : *sorter; }
  /// Returns the first value of State::out_of_order for a search.
  [[nodiscard]] std::uint32_t is_not_asked_for_order() const {
    return plan.allowed.has(Skip::sort) ? 0 : 1;
  }
  [[nodiscard]] PairTest test() const { return grows() ? PairTest::filter_safe : plan.test; }

  /// Returns cell ids (keys) with their objects (values), [plan.capacity.ids]. They are on side 0
  /// before the sort.
  [[nodiscard]] KeysAndValues side(int which) const {
    return arrays_in(ids[which].data(), plan.capacity.ids);
  }
  [[nodiscard]] KeysAndValues sorted() const {
    return side(sorter ? sorter_now().result_side() : 0);
  }

  /// Calls visit(array, elements) for each array, with the size that the plan gives.
  template <typename Visit>
  void for_each_array(Visit visit) {
    const Capacities& room = plan.capacity;
    visit(state, 1);
    visit(spheres, sphere_count());
    visit(flags, scene.flags.size());
    for (auto& side : ids) visit(side, tiles() ? 0 : words_of_side(room.ids));
    const bool phantoms = plan.method == Method::home_phantom;
    visit(wide_spheres, phantoms ? room.ids / kWidePhantoms : 0);
    const std::uint64_t grown_scratch = grown_sorter ? grown_sorter->scratch_bytes() : 0;
    visit(sort_scratch, std::max(sorter ? sorter->scratch_bytes() : 0, grown_scratch));
    visit(control_bits, plan.rule == Rule::chapter32 ? sphere_count() : 0);
    visit(crowded_tiles, phantoms ? room.ids / kBlockThreads : 0);
    visit(sorted_spheres, half_shell() ? sphere_count() + kReadBehind : 0);
    visit(sorted_packed, half_shell() && is_packed(plan.test) ? sphere_count() + kReadBehind : 0);
    const std::uint32_t starts = starts_shape(plan.levels, plan.facts.sphere_count).starts();
    const std::uint32_t grown_starts =
        starts_shape(plan.skin.levels, plan.facts.sphere_count).starts();
    visit(cell_starts, half_shell() ? std::max(starts, grown_starts) : 0);
    const std::uint64_t tile_count = tiles() ? plan.tiles.tile_count() : 0;
    visit(tile_records, tile_count * room.tile_records);
    visit(tile_sizes, tile_count);
    visit(uncertain_pairs, room.uncertain_pairs);
    visit(pairs, room.pairs);
    visit(history, coherent() ? 1 : 0);
    visit(sample, coherent() ? coherence::kSampled : 0);
    visit(snapshot, allowed().unchanged ? sphere_count() : 0);
    visit(searched, allowed().neighbor_list ? sphere_count() : 0);
    visit(neighbor_list, allowed().near_room);
  }
};

/// Returns how many blocks are needed for one thread per item.
inline unsigned blocks_for(std::uint64_t items, std::uint64_t items_per_block = kBlockThreads) {
  return static_cast<unsigned>((items + items_per_block - 1) / items_per_block);
}

void bounds(Workspace& w);
void cell_ids(Workspace& w);
void sort(Workspace& w);
void cell_index(Workspace& w);
void pair_tests(Workspace& w);
void resolve(Workspace& w);

/// Waits, then copies what a stage has written into the record, and makes room for what the next
/// one writes down itself.
void write_down(Workspace& w, Stage stage, RunRecord& record);

}  // namespace octocell::cuda_custom
