// SPDX-License-Identifier: MIT
// Stage 5, pair_tests: which spheres that share a cell overlap?
// Reads spheres, sorted cell ids and objects, crowded tiles. Writes certain pairs, and uncertain
//       pairs for stage 6.
// Cost: 8 bytes an id and a gathered sphere of 16; then about 15 operations a candidate.
// Idea: a block takes a tile of 256 entries as rows. Each row is tested against the entries behind
//       it in its cell, up to the end of the next tile. Both tiles are in shared memory; each
//       sphere is gathered once. In crowded cells, a second kernel tests what lies beyond, tile by
//       tile. So each candidate belongs to exactly one of the two kernels, however large its cell
//       is.
#include <cstdint>
#include <type_traits>

#include "core/pair_rule.hpp"
#include "impl_cuda_custom/coherence/frames.cuh"
#include "impl_cuda_custom/half_shell/pair_tests.cuh"
#include "impl_cuda_custom/pair_sinks.cuh"
#include "impl_cuda_custom/pair_test.cuh"
#include "impl_cuda_custom/tiles/tiles.cuh"

namespace octocell::cuda_custom {
namespace {

constexpr int kTile = kBlockThreads;

struct PairTestsJob {
  const Sphere* spheres;
  const std::uint32_t* cell_ids;  // null: brute_force, where all entries lie in one cell
  const Object* objects;          // null: entry k is sphere k
  const CrowdedTile* crowded_tiles;
  PairRule rule;
  AnyTest test;
  std::uint64_t candidate_limit;
  SinkArguments sink;
  Considered* considered;           // [candidates], only for a run that is recorded
  std::uint64_t* considered_count;  // the same

  /// Returns the same for all threads: nothing that it reads changes in this stage.
  [[nodiscard]] __device__ bool may_test() const {
    const State& state = *sink.state;
    return state.violations == 0 && state.candidates <= candidate_limit;
  }
  [[nodiscard]] __device__ std::uint64_t entries() const { return sink.state->entries; }
  [[nodiscard]] __device__ std::uint32_t cell_id_at(std::uint64_t entry) const {
    return cell_ids != nullptr ? cell_ids[entry] : 0;
  }
  [[nodiscard]] __device__ Member gather(std::uint64_t entry) const {
    const Object object = objects != nullptr ? objects[entry] : static_cast<Object>(entry);
    Sphere s = load_sphere(spheres, object & kIdMask);
    s.r = stored_radius(test.test, s.r);
    return {s, object};
  }
  /// Returns how many crowded tiles there are. brute_force has one cell, so they need not be
  /// listed.
  [[nodiscard]] __device__ std::uint64_t crowded_tile_count() const {
    if (cell_ids != nullptr) return sink.state->crowded_tiles;
    return entries() > 2 * kTile ? (entries() - 2 * kTile - 1) / kTile + 1 : 0;
  }
  [[nodiscard]] __device__ CrowdedTile crowded_tile(std::uint64_t number) const {
    if (cell_ids != nullptr) return crowded_tiles[number];
    return {static_cast<std::uint32_t>(number * kTile), static_cast<std::uint32_t>(entries())};
  }
};

/// Entries side by side in shared memory.
template <int kRoom>
struct Members {
  float4 sphere[kRoom];
  Object object[kRoom];

  __device__ void put(int at, const Member& m) {
    sphere[at] = {m.sphere.x, m.sphere.y, m.sphere.z, m.sphere.r};
    object[at] = m.object;
  }
  [[nodiscard]] __device__ Member get(int at) const {
    const float4 s = sphere[at];
    return {{s.x, s.y, s.z, s.w}, object[at]};
  }
};

/// Keeps pairs, and makes the kernels write down each candidate: for a run that is recorded.
class KeepRecorded : public Keep {
 public:
  using Keep::Keep;
};
template <typename Sink>
constexpr bool kRecorded = std::is_same_v<Sink, KeepRecorded>;

__device__ void write_down(const PairTestsJob& job, std::uint64_t row_entry, Pair row_and_other,
                           Judgement judgement) {
  const auto [i, j] = row_and_other;
  const bool found = judgement == Judgement::overlap || judgement == Judgement::uncertain;
  if (found && job.sink.keeps_apart(make_pair_of(i, j))) judgement = Judgement::flags;
  const std::uint64_t place = atomic_add(job.considered_count, 1U);
  job.considered[place] = {i, j, job.cell_id_at(row_entry), judgement};
}

/// Tests one candidate per lane; lanes that are not `open` have none. All lanes of the warp must
/// call it. `row_entry` is the place of `a` among the sorted ids.
template <typename Sink>
__device__ void test_pair(const PairTestsJob& job, Sink& sink, bool open, std::uint64_t row_entry,
                          const Member& a, const Member& b) {
  const bool near = open && job.test.may_overlap(a.sphere, b.sphere);
  const bool found = near && job.rule.counts_here(a, b);
  if (!kRecorded<Sink> && !__any_sync(kAllLanes, found)) return;
  const Verdict verdict = found ? job.test.verdict_on(a.sphere, b.sphere) : Verdict::apart;
  if constexpr (kRecorded<Sink>) {
    const Judgement judgement = near && !found ? Judgement::other_cell : judgement_of(verdict);
    if (open) write_down(job, row_entry, {a.id(), b.id()}, judgement);
  }
  sink.take(verdict, make_pair_of(a.id(), b.id()));
}

/// A tile, followed by those entries of the next tile that are in the same cell as its last entry.
struct NearTile {
  Members<2 * kTile> members;
  std::uint32_t cell_id[2 * kTile];

  /// Returns the number of entries. Does not gather spheres that are alone in their cell.
  __device__ int load(const PairTestsJob& job, std::uint64_t begin) {
    const auto t = static_cast<int>(threadIdx.x);
    const std::uint64_t entries = job.entries();
    const std::uint64_t here = begin + t;
    const std::uint64_t next = here + kTile;
    if (here < entries) cell_id[t] = job.cell_id_at(here);
    const bool goes_on =
        next < entries && job.cell_id_at(next) == job.cell_id_at(begin + kTile - 1);
    if (goes_on) cell_id[t + kTile] = job.cell_id_at(next);
    const int rows = static_cast<int>(min(std::uint64_t{kTile}, entries - begin));
    const int size = rows + __syncthreads_count(goes_on);
    if (here < entries && has_company(t, size)) members.put(t, job.gather(here));
    if (goes_on) members.put(t + kTile, job.gather(next));
    __syncthreads();
    return size;
  }

 private:
  [[nodiscard]] __device__ bool has_company(int at, int size) const {
    const bool before = at > 0 && cell_id[at - 1] == cell_id[at];
    return before || (at + 1 < size && cell_id[at + 1] == cell_id[at]);
  }
};

template <typename Sink>
__global__ void __launch_bounds__(kBlockThreads, Sink::kBlocksAtOnce)
    near_columns_kernel(PairTestsJob job) {
  __shared__ NearTile tile;
  __shared__ typename Sink::Shared shared;
  const std::uint64_t begin = std::uint64_t{blockIdx.x} * kTile;
  if (begin >= job.entries() || !job.may_test()) return;
  const int size = tile.load(job, begin);
  Sink sink(job.sink, shared);

  const auto t = static_cast<int>(threadIdx.x);
  const auto in_same_cell = [&](int column) {
    return column < size && tile.cell_id[column] == tile.cell_id[t];
  };
  bool open = in_same_cell(t + 1);
  const Member row = open ? tile.members.get(t) : Member{};
  open = open && job.rule.may_be_row(row);
  for (int column = t + 1; __any_sync(kAllLanes, open); ++column) {
    test_pair(job, sink, open, begin + t, row, open ? tile.members.get(column) : Member{});
    open = open && in_same_cell(column + 1);
  }
  sink.close();
}

/// Block (x, y) takes crowded tile x as rows, and every gridDim.y-th tile of columns behind the
/// next.
template <typename Sink>
__global__ void __launch_bounds__(kBlockThreads, Sink::kBlocksAtOnce)
    far_columns_kernel(PairTestsJob job) {
  __shared__ Members<kTile> columns;
  __shared__ typename Sink::Shared shared;
  if (!job.may_test()) return;
  const std::uint64_t tiles = job.crowded_tile_count();
  if (blockIdx.x >= tiles) return;
  Sink sink(job.sink, shared);

  const auto t = static_cast<int>(threadIdx.x);
  for (std::uint64_t number = blockIdx.x; number < tiles; number += gridDim.x) {
    const CrowdedTile rows = job.crowded_tile(number);
    const std::uint64_t tile_begin = rows.row_begin / kTile * std::uint64_t{kTile};
    const Member row = job.gather(tile_begin + t);
    const bool open = tile_begin + t >= rows.row_begin && job.rule.may_be_row(row);
    const std::uint64_t stride = std::uint64_t{gridDim.y} * kTile;
    for (std::uint64_t begin = tile_begin + (2 + blockIdx.y) * std::uint64_t{kTile};
         begin < rows.cell_end; begin += stride) {
      const int size = static_cast<int>(min(std::uint64_t{kTile}, rows.cell_end - begin));
      __syncthreads();  // all threads have finished with the last columns
      if (t < size) columns.put(t, job.gather(begin + t));
      __syncthreads();
      for (int c = 0; c < size; ++c)
        test_pair(job, sink, open, tile_begin + t, row, columns.get(c));
    }
  }
  sink.close();
}

PairTestsJob job_of(Workspace& w) {
  const bool brute = w.brute_force();
  return {.spheres = w.spheres.data(),
          .cell_ids = brute ? nullptr : w.sorted().keys,
          .objects = brute ? nullptr : w.sorted().values,
          .crowded_tiles = w.crowded_tiles.data(),
          .rule = {.every_pair = brute,
                   .rule = w.plan.rule,
                   .control_bits = w.control_bits.data(),
                   .text_side = as_written::cell_side(w.plan.facts.r_max)},
          .test = {w.plan.test, w.plan.packing},
          .candidate_limit = w.plan.candidate_limit,
          .sink = sink_arguments_of(w),
          .considered = w.considered.data(),
          .considered_count = w.considered_count.data()};
}

template <typename Sink>
void test_columns(Workspace& w, std::uint64_t most_entries) {
  const PairTestsJob job = job_of(w);
  near_columns_kernel<Sink><<<blocks_for(most_entries), kBlockThreads, 0, w.stream>>>(job);
  cuda::check_launch();
  if (most_entries <= 2 * kTile) return;
  // Enough blocks for a device, whether there are many crowded tiles or a few with many columns.
  const dim3 tiles_by_columns(256, 16);
  far_columns_kernel<Sink><<<tiles_by_columns, kBlockThreads, 0, w.stream>>>(job);
  cuda::check_launch();
}

}  // namespace

void pair_tests(Workspace& w) {
  if (w.plan.method == Method::tiles) return tiles::find_in_tiles(w);
  if (w.plan.method == Method::half_shell) {
    if (w.may_take(FrameMode::search)) half_shell::pair_tests(w);
    if (w.may_take(FrameMode::neighbor_list)) coherence::test_neighbor_list(w);
    return;
  }
  const std::uint64_t most_entries = w.brute_force() ? w.sphere_count() : w.plan.capacity.ids;
  if (w.sphere_count() == 0 || most_entries == 0) return;
  if (w.plan.count_only) return test_columns<Count>(w, most_entries);
  if (w.record != nullptr) return test_columns<KeepRecorded>(w, most_entries);
  test_columns<Keep>(w, most_entries);
}

}  // namespace octocell::cuda_custom
