// SPDX-License-Identifier: MIT
// The first kernel of a frame: what may be reused from the last?  It compares every sphere with the
// snapshot, or with its place in the last search, as long as that can still prove something. The
// block that ends last decides. If there is nothing to prove, no sphere is read.
#include <algorithm>
#include <cstdint>

#include "core/pair.hpp"
#include "impl_cuda_custom/coherence/frames.cuh"
#include "impl_cuda_custom/device.cuh"
#include "impl_cuda_custom/radix_sort/digit_histograms.cuh"

namespace octocell::cuda_custom::coherence {
namespace {

constexpr int kAtOnce = 2;  // spheres that a thread has in flight
constexpr std::uint32_t kPerBlock = kBlockThreads * kAtOnce;
/// Fills the chip, but leaves each block several steps: what it finds in one may make the next
/// unnecessary.
constexpr std::uint32_t kMostBlocks = 396;
constexpr int kBlocksAtOnce = 3;
static_assert(kSampled == kBlockThreads, "a thread for each sphere of the sample");

struct OpenFrameJob {
  const Sphere* spheres;
  const Flags* flags;  // may be null
  std::uint32_t count;
  Sphere* snapshot;
  const Sphere* searched;
  Sphere* sample;
  PlanFacts facts;
  Allowed allowed;
  Capacities room;
  std::uint64_t candidate_limit;
  float growth;             // of this frame's search
  State search;             // the first State of a search
  std::uint32_t* counters;  // of the search's sort; they are cleared here
  std::uint32_t counter_count;
  State* state;
  FrameHistory* history;
  FrameMode* taken;  // in the host's memory

  /// Returns true if the last frame found all pairs.
  [[nodiscard]] __device__ bool is_complete(const State& last) const {
    return last.violations == 0 && last.candidates <= candidate_limit && last.pairs <= room.pairs &&
           last.uncertain_pairs <= room.uncertain_pairs;
  }
};

__device__ std::uint32_t or_over_warp(std::uint32_t bits) {
#if __CUDA_ARCH__ >= 800
  return __reduce_or_sync(kAllLanes, bits);
#else
  for (int distance = kWarpThreads / 2; distance > 0; distance /= 2) {
    bits |= __shfl_xor_sync(kAllLanes, bits, distance);
  }
  return bits;
#endif
}

/// Not inlined, like overlap().
__device__ __noinline__ bool is_within_exactly(const Sphere& then, const Sphere& now,
                                               float growth) {
  const SkinTest test = skin_test_of(then, now, growth);
  return overlap_exact(test.ball, test.point);
}

/// Returns false for a sphere outside the plan's facts: then a search reports it.
__device__ bool is_within_skin(const OpenFrameJob& job, const Sphere& then, const Sphere& now,
                               float growth) {
  if (violation_of(now, job.facts) != 0) return false;
  const Verdict verdict = within_skin(then, now, growth);
  if (verdict != Verdict::uncertain) return verdict == Verdict::overlap;
  return is_within_exactly(then, now, growth);
}

/// Measures one sphere of the sample with each thread of the first block: how many stand still, and
/// the longest way that one moved.
__device__ void observe_sample(const OpenFrameJob& job) {
  const auto k = threadIdx.x;
  const auto chosen = static_cast<std::uint32_t>(mix_pair({0, k}) % job.count);
  const Sphere now = load_sphere(job.spheres, chosen);
  const Sphere before = job.history->frames != 0 ? job.sample[k] : now;
  store_sphere(job.sample, k, now);
  const float dx = now.x - before.x;
  const float dy = now.y - before.y;
  const float dz = now.z - before.z;
  float way = sqrtf(dx * dx + dy * dy + dz * dz);
  if (bits_of(now.r) != bits_of(before.r) || !(way <= kFloatMax)) way = INFINITY;
  const std::uint32_t farthest = max_over_warp(bits_of(way));  // non-negative floats compare like
                                                               // their bits
  if (lane() == 0) atomicMax(&job.history->farthest_now, farthest);
  const int still = __syncthreads_count(same_bits(now, before));
  if (k == 0) job.history->still_now = static_cast<std::uint32_t>(still);
}

/// Compares a sphere with `before`: its snapshot if `compares`, otherwise its place in the last
/// search. If it equals the snapshot, it is within the skin, too: the last frame either was the
/// search or was compared with the same search.
__device__ std::uint32_t look_at(const OpenFrameJob& job, const FrameTasks& tasks, bool compares,
                                 float growth, std::uint32_t i, const Sphere& now,
                                 const Sphere& before) {
  if (tasks.take_snapshot) store_sphere(job.snapshot, i, now);
  if (compares && same_bits(now, before)) return 0;
  if (!tasks.check_skin) return kDiffers;
  const Sphere then = compares ? load_sphere(job.searched, i) : before;
  const bool within = is_within_skin(job, then, now, growth_of(job.flags, i, growth));
  return within ? kDiffers : kDiffers | kLeft;
}

/// Returns what was found, the same for all lanes of a warp. A warp stops when it has found enough
/// to rule out everything that is tried.
__device__ std::uint32_t look_at_spheres(const OpenFrameJob& job, const FrameTasks& tasks,
                                         float growth) {
  std::uint32_t found = 0;
  for (std::uint32_t begin = blockIdx.x * kPerBlock; begin < job.count;
       begin += gridDim.x * kPerBlock) {
    const bool compares = tasks.compare && (found & kDiffers) == 0;
    const bool proves = compares || (tasks.check_skin && (found & kLeft) == 0);
    if (!proves && !tasks.take_snapshot) break;
    const Sphere* const others = compares           ? job.snapshot
                                 : tasks.check_skin ? job.searched
                                                    : job.spheres;
    Sphere now[kAtOnce];
    Sphere before[kAtOnce];
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {
      const std::uint32_t i = min(begin + k * kBlockThreads + threadIdx.x, job.count - 1);
      now[k] = load_sphere(job.spheres, i);
      before[k] = load_sphere(others, i);
    }
    std::uint32_t here = 0;
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {
      const std::uint32_t i = begin + k * kBlockThreads + threadIdx.x;
      if (i < job.count) here |= look_at(job, tasks, compares, growth, i, now[k], before[k]);
    }
    found |= or_over_warp(here);
  }
  return found;
}

__device__ State opened(const OpenFrameJob& job, const State& last, const FrameHistory& history,
                        FrameMode mode) {
  if (mode == FrameMode::search) return job.search;
  State state;
  state.mode = mode;
  if (mode == FrameMode::unchanged) state.pairs = last.pairs;
  if (mode == FrameMode::neighbor_list) state.candidates = history.neighbor_list;
  return state;
}

/// Decides the mode. For the last block: no other block reads State or FrameHistory any more.
__device__ void decide(const OpenFrameJob& job, const FrameTasks& tasks) {
  FrameHistory history = *job.history;
  history.still_now = __ldcg(&job.history->still_now);
  history.farthest_now = __ldcg(&job.history->farthest_now);
  const FrameMode mode = mode_of(tasks, __ldcg(&job.history->found));
  *job.state = opened(job, *job.state, history, mode);
  *job.history = after(history, tasks, mode, job.allowed, job.growth);
  *job.taken = mode;
}

__global__ void __launch_bounds__(kBlockThreads, kBlocksAtOnce)
    open_frame_kernel(const __grid_constant__ OpenFrameJob job) {
  const std::uint32_t threads = gridDim.x * kBlockThreads;
  for (std::uint32_t k = blockIdx.x * kBlockThreads + threadIdx.x; k < job.counter_count;
       k += threads) {
    job.counters[k] = 0;
  }
  const bool complete = job.history->frames != 0 && job.is_complete(*job.state);
  const FrameTasks tasks = tasks_of(*job.history, complete, job.allowed);
  if (blockIdx.x == 0) observe_sample(job);
  const std::uint32_t found = look_at_spheres(job, tasks, job.history->growth);
  if (found != 0 && lane() == 0) atomicOr(&job.history->found, found);
  const bool is_last = digit_histograms::is_last_block(&job.history->blocks_done);
  if (is_last && threadIdx.x == 0) decide(job, tasks);
}

State search_of(const Workspace& w) {
  State state;
  state.ids = w.sphere_count();
  state.out_of_order = w.is_not_asked_for_order();
  return state;
}

}  // namespace

void open_frame(Workspace& w) {
  const auto count = static_cast<std::uint32_t>(w.sphere_count());
  const OpenFrameJob job = {
      .spheres = w.spheres.data(),
      .flags = w.flags_or_none(),
      .count = count,
      .snapshot = w.snapshot.data(),
      .searched = w.searched.data(),
      .sample = w.sample.data(),
      .facts = w.plan.facts,
      .allowed = w.allowed(),
      .room = w.plan.capacity,
      .candidate_limit = w.plan.candidate_limit,
      .growth = w.growth,
      .search = search_of(w),
      .counters = reinterpret_cast<std::uint32_t*>(w.sort_scratch.data()),
      .counter_count = static_cast<std::uint32_t>(w.sorter_now().zeroed_words()),
      .state = w.state.data(),
      .history = w.history.data(),
      .taken = w.mode_taken.data()};
  open_frame_kernel<<<std::min(parts_of(count, kPerBlock), kMostBlocks), kBlockThreads, 0,
                      w.stream>>>(job);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom::coherence
