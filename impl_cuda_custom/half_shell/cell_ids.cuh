// SPDX-License-Identifier: MIT
// Stage 2 of half_shell: writes one id a sphere. While the sphere is in registers, the kernel also
// compares it with the plan's facts (stage 1) and counts the digits of its id (stage 3).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "impl_cuda_custom/radix_sort/digit_histograms.cuh"

namespace octocell::cuda_custom::half_shell {

struct ColumnIdsJob {
  const Sphere* spheres;
  std::uint32_t sphere_count;
  PlanFacts facts;
  Levels levels;
  bool may_leave;      // true if this frame may turn out not to be a search
  float growth;        // of the radii; may be 0
  const Flags* flags;  // may be null
  Sphere* searched;    // output: the spheres as they are in this search; may be null
  std::uint32_t* cell_ids;
  Object* objects;
  State* state;
  digit_histograms::HistogramsJob digits;

  [[nodiscard]] __device__ std::uint32_t id_of(std::uint32_t i, const Sphere& s) const {
    const float r = coherence::radius_in_search(s, flags, i, growth);
    const Level& level = levels.level[level_of(levels, r)];
    return level.first_id + cell_id(level.grid, cell_of(level.grid, s.x, s.y, s.z));
  }
};

constexpr int kIdsThreads = digit_histograms::kThreads;
constexpr int kSpheresAtOnce = 2;          // a thread has that many loads in flight
constexpr std::uint32_t kIdsBlocks = 264;  // fills the chip; each block adds its counts to the
                                           // common ones

/// What a thread has found.
struct Met {
  std::uint32_t violations = 0;
  bool out_of_order = false;  // some id is below that of the sphere before, in its warp's part
};

/// Returns the size of a warp's part. Each warp has consecutive spheres, so it sees their ids in
/// order.
__device__ inline std::uint32_t spheres_of_warp(const ColumnIdsJob& job) {
  const std::uint32_t warps = gridDim.x * (kIdsThreads / kWarpThreads);
  return parts_of(parts_of(job.sphere_count, warps), kWarpThreads) * kWarpThreads;
}

template <int kPasses>
__device__ Met put_ids(const ColumnIdsJob& job, std::uint32_t* counts) {
  const std::uint32_t size = spheres_of_warp(job);
  const std::uint32_t warp = (blockIdx.x * kIdsThreads + threadIdx.x) / kWarpThreads;
  const std::uint32_t begin = min(warp * size, job.sphere_count);
  const std::uint32_t end = min(begin + size, job.sphere_count);
  Met met;
  std::uint32_t last = 0;  // the last id of the previous 32 spheres
  for (std::uint32_t first = begin; first < end; first += kSpheresAtOnce * kWarpThreads) {
    Sphere spheres[kSpheresAtOnce];
#pragma unroll
    for (int k = 0; k < kSpheresAtOnce; ++k) {
      const std::uint32_t i = first + k * kWarpThreads + lane();
      if (i < end) spheres[k] = load_sphere(job.spheres, i);
    }
#pragma unroll
    for (int k = 0; k < kSpheresAtOnce; ++k) {
      const std::uint32_t i = first + k * kWarpThreads + lane();
      std::uint32_t id = ~0U;
      if (i < end) {
        met.violations |= violation_of(spheres[k], job.facts);
        if (job.searched != nullptr) store_sphere(job.searched, i, spheres[k]);
        id = job.id_of(i, spheres[k]);
        job.cell_ids[i] = id;
        job.objects[i] = i;
        digit_histograms::count_key<kPasses>(job.digits, id, counts);
      }
      const std::uint32_t below = __shfl_up_sync(kAllLanes, id, 1);
      met.out_of_order |= (lane() == 0 ? last : below) > id;
      last = __shfl_sync(kAllLanes, id, kWarpThreads - 1);
    }
  }
  return met;
}

/// Checks the order between the parts of warps, which no warp has seen. For the last block.
__device__ inline bool out_of_order_between_warps(const ColumnIdsJob& job) {
  const std::uint32_t size = spheres_of_warp(job);
  bool found = false;
#pragma unroll 4
  for (std::uint32_t i = (threadIdx.x + 1) * size; i < job.sphere_count; i += kIdsThreads * size) {
    found |= __ldcg(&job.cell_ids[i - 1]) > __ldcg(&job.cell_ids[i]);
  }
  return found;
}

template <int kPasses>
__global__ void __launch_bounds__(kIdsThreads, 2)
    ids_kernel(const __grid_constant__ ColumnIdsJob job) {
  extern __shared__ std::uint32_t counts[];
  State* const state = job.state;
  if (job.may_leave && state->mode != FrameMode::search) return;
  digit_histograms::open<kPasses>(job.digits, job.sphere_count, counts);
  const Met met = put_ids<kPasses>(job, counts);
  if (met.violations != 0) atomicOr(&state->violations, met.violations);
  const bool out_of_order = __syncthreads_or(met.out_of_order) != 0;
  if (out_of_order && threadIdx.x == 0) state->out_of_order = 1;
  if (!digit_histograms::close<kPasses>(job.digits, counts)) return;
  const bool in_order = __ldcg(&state->out_of_order) == 0;
  if (in_order && out_of_order_between_warps(job)) state->out_of_order = 1;
  if (threadIdx.x != 0) return;
  if (atomicOr(&state->violations, 0U) == 0) state->entries = job.sphere_count;
}

inline void cell_ids(Workspace& w) {
  if (!w.half_shell()) return;
  State* const state = w.state.data();
  const ColumnIdsJob job = {
      .spheres = w.spheres.data(),
      .sphere_count = static_cast<std::uint32_t>(w.sphere_count()),
      .facts = w.plan.facts,
      .levels = w.levels(),
      .may_leave = w.coherent(),
      .growth = w.growth,
      .flags = w.flags_or_none(),
      .searched = w.allowed().neighbor_list ? w.searched.data() : nullptr,
      .cell_ids = w.side(0).keys,
      .objects = w.side(0).values,
      .state = state,
      .digits = w.sorter_now().histograms(&state->ids, w.sort_scratch.data())};
  constexpr void (*kByPasses[])(ColumnIdsJob) = {ids_kernel<1>, ids_kernel<2>, ids_kernel<3>,
                                                 ids_kernel<4>};
  const int passes = w.sorter_now().passes();
  const std::uint32_t blocks = std::min(parts_of(job.sphere_count, kIdsThreads), kIdsBlocks);
  const std::size_t shared = digit_histograms::shared_bytes(job.digits, passes);
  kByPasses[passes - 1]<<<blocks, kIdsThreads, shared, w.stream>>>(job);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom::half_shell
