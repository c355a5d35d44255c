// SPDX-License-Identifier: MIT
// Stage 4 of half_shell: where does each cell begin?  Gathers the spheres in the order of their
// cells, once, so that stage 5 reads consecutive memory; also counts the candidates.
#pragma once

#include <cstdint>

#include "impl_cuda_custom/half_shell/neighbours.cuh"
#include "impl_cuda_custom/pair_test.cuh"

namespace octocell::cuda_custom::half_shell {

/// How many starts a block finds.
constexpr int kStartsPerThread = 8;
constexpr std::uint32_t kStartsPerBlock = kBlockThreads * kStartsPerThread;
constexpr std::uint32_t kMostStaged = 4096;  // a block copies up to that many sorted ids to shared
                                             // memory to search them

/// Returns the first of `count` places whose id is `id` or above. A warp divides the range by 32
/// where a thread would halve it. All lanes must call it.
__device__ inline std::uint32_t search_by_warp(const std::uint32_t* cell_ids, std::uint32_t count,
                                               std::uint32_t id) {
  std::uint32_t begin = 0;
  std::uint32_t end = count;
  while (begin < end) {
    const std::uint32_t step = parts_of(end - begin, kWarpThreads);
    const std::uint32_t probe = begin + (lane() + 1) * step - 1;
    const bool below = probe < end && cell_ids[probe] < id;
    begin += __popc(__ballot_sync(kAllLanes, below)) * step;
    end = min(end, begin + step - 1);
  }
  return begin;
}

/// Searches for every start: first the block, then its threads within the part that the block
/// found. So the time does not depend on how the spheres are spread. (If instead the thread of each
/// sphere filled the gap before it, this would take 20 times as long for spheres in clusters.)
__global__ void __launch_bounds__(kBlockThreads)
    starts_kernel(CellStarts to, std::uint32_t starts, const State* state) {
  __shared__ std::uint32_t ends[2];
  __shared__ std::uint32_t staged[kMostStaged];
  const auto entries = static_cast<std::uint32_t>(state->entries);
  if (entries == 0) return;
  const std::uint32_t first = blockIdx.x * kStartsPerBlock;
  if (warp() < 2) {
    const std::uint32_t group = min(first + warp() * kStartsPerBlock, starts - 1);
    const std::uint32_t place = search_by_warp(to.cell_ids, entries, group << to.shift);
    if (lane() == 0) ends[warp()] = place;
  }
  __syncthreads();

  std::uint32_t length = ends[1] - ends[0];
  const std::uint32_t* ids = to.cell_ids + ends[0];
  if (length <= kMostStaged) {
    for (std::uint32_t i = threadIdx.x; i < length; i += kBlockThreads) staged[i] = ids[i];
    __syncthreads();
    ids = staged;
  }
  std::uint32_t places[kStartsPerThread] = {};  // relative to ends[0]
  while (length > 0) {  // all searches advance together, so their loads overlap
    const std::uint32_t half = (length + 1) / 2;
#pragma unroll
    for (int k = 0; k < kStartsPerThread; ++k) {
      const std::uint32_t id = (first + k * kBlockThreads + threadIdx.x) << to.shift;
      if (ids[places[k] + half - 1] < id) places[k] += half;
    }
    length -= half;
  }
#pragma unroll
  for (int k = 0; k < kStartsPerThread; ++k) {
    const std::uint32_t group = first + k * kBlockThreads + threadIdx.x;
    if (group < starts) to.starts[group] = ends[0] + places[k];
  }
}

constexpr int kOrderedPerThread = 2;  // spheres that a thread gathers at once
constexpr std::uint32_t kOrderedPerBlock = kBlockThreads * kOrderedPerThread;

template <typename Neighbours>
struct OrderJob {
  Neighbours neighbours;
  const Sphere* spheres;  // in the scene's order
  Sphere* ordered;
  PackedSphere* packed;  // for packed tests
  PairTest test;
  Packing packing;
  float growth;
  const Flags* flags;  // may be null
  State* state;

  __device__ void put(std::uint32_t place, Sphere s) const {
    if (is_packed(test)) packed[place] = pack(test, s, packing);
    s.r = stored_radius(test, s.r);
    reinterpret_cast<float4*>(ordered)[place] = {s.x, s.y, s.z, s.r};
  }
  [[nodiscard]] __device__ Sphere in_search(std::uint32_t place, const Sphere& s) const {
    const std::uint32_t sphere = neighbours.objects[place];
    return {s.x, s.y, s.z, coherence::radius_in_search(s, flags, sphere, growth)};
  }
};

template <typename Neighbours>
__global__ void __launch_bounds__(kBlockThreads)
    order_kernel(const __grid_constant__ OrderJob<Neighbours> job) {
  const auto entries = static_cast<std::uint32_t>(job.state->entries);
  const std::uint32_t block_begin = blockIdx.x * kOrderedPerBlock;
  if (entries == 0 || block_begin >= entries + kReadBehind) return;
  const std::uint32_t* const ids = job.neighbours.starts.cell_ids;
  Sphere spheres[kOrderedPerThread];
#pragma unroll
  for (int k = 0; k < kOrderedPerThread; ++k) {
    const std::uint32_t place = block_begin + k * kBlockThreads + threadIdx.x;
    if (place < entries) spheres[k] = load_sphere(job.spheres, job.neighbours.objects[place]);
  }
  std::uint64_t candidates = 0;
  std::uint32_t cells = 0;
#pragma unroll
  for (int k = 0; k < kOrderedPerThread; ++k) {
    const std::uint32_t place = block_begin + k * kBlockThreads + threadIdx.x;
    const bool present = place < entries;
    const std::uint32_t id = present ? ids[place] : 0;
    if (present && (place == 0 || ids[place - 1] != id)) ++cells;
    candidates += job.neighbours.count_neighbours(present, place, id, spheres[k]);
    if (present) job.put(place, job.in_search(place, spheres[k]));
    if (place >= entries && place < entries + kReadBehind) job.put(place, {});
  }
  add_over_block(&job.state->cells, cells);
  add_over_block(&job.state->candidates, candidates);
}

inline void cell_index(Workspace& w) {
  if (!w.half_shell()) return;
  const std::uint32_t starts = starts_shape(w.levels(), w.plan.facts.sphere_count).starts();
  starts_kernel<<<parts_of(starts, kStartsPerBlock), kBlockThreads, 0, w.stream>>>(
      starts_of(w), starts, w.state.data());
  cuda::check_launch();
  with_neighbours(w, [&](const auto& neighbours) {
    const OrderJob job = {.neighbours = neighbours,
                          .spheres = w.spheres.data(),
                          .ordered = w.sorted_spheres.data(),
                          .packed = w.sorted_packed.data(),
                          .test = w.test(),
                          .packing = w.plan.packing,
                          .growth = w.growth,
                          .flags = w.flags_or_none(),
                          .state = w.state.data()};
    const unsigned blocks = blocks_for(w.sphere_count() + kReadBehind, kOrderedPerBlock);
    order_kernel<<<blocks, kBlockThreads, 0, w.stream>>>(job);
    cuda::check_launch();
  });
}

}  // namespace octocell::cuda_custom::half_shell
