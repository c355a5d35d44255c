// SPDX-License-Identifier: MIT
// Which neighbor pairs overlap now?  They are listed cell by cell, and the cache of a large GPU
// holds all spheres, so spheres are read without gathering them first.
#include "impl_cuda_custom/coherence/neighbor_list.cuh"

#include <algorithm>
#include <cstdint>

#include "impl_cuda_custom/coherence/frames.cuh"

namespace octocell::cuda_custom::coherence {
namespace {

constexpr int kAtOnce = 2;  // neighbor pairs that a thread has in flight
constexpr std::uint32_t kPerBlock = kBlockThreads * kAtOnce;
constexpr std::uint64_t kMostBlocks = 792;

struct NeighborListJob {
  const Pair* neighbor_list;
  const FrameHistory* history;
  const Sphere* spheres;
  Filter filter;
  PairList pairs;
  PairList uncertain_pairs;
  const State* state;
};

__global__ void __launch_bounds__(kBlockThreads, 6) neighbor_list_kernel(NeighborListJob job) {
  __shared__ PairWriter::Shared shared_pairs;
  __shared__ PairWriter::Shared shared_uncertain_pairs;
  if (job.state->mode != FrameMode::neighbor_list) return;
  const std::uint64_t count = job.history->neighbor_list;
  PairWriter pairs(job.pairs, shared_pairs);
  PairWriter uncertain_pairs(job.uncertain_pairs, shared_uncertain_pairs);
  const std::uint64_t stride = std::uint64_t{gridDim.x} * kPerBlock;
  for (std::uint64_t begin = std::uint64_t{blockIdx.x} * kPerBlock; begin < count;
       begin += stride) {
    Pair near[kAtOnce] = {};
    Verdict verdicts[kAtOnce];
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {
      const std::uint64_t place = begin + k * kBlockThreads + threadIdx.x;
      if (place >= count) break;
      const uint2 pair = __ldg(reinterpret_cast<const uint2*>(job.neighbor_list) + place);
      near[k] = {pair.x, pair.y};
    }
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {  // beyond the end, near[k] is {0, 0}; its verdict is not
                                         // used
      verdicts[k] = test_in_float32(job.filter, load_sphere(job.spheres, near[k].i),
                                    load_sphere(job.spheres, near[k].j));
    }
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {
      const bool present = begin + k * kBlockThreads + threadIdx.x < count;
      pairs.push(present && verdicts[k] == Verdict::overlap, near[k]);
      uncertain_pairs.push(present && verdicts[k] == Verdict::uncertain, near[k]);
    }
  }
  pairs.close();
  uncertain_pairs.close();
}

}  // namespace

void test_neighbor_list(Workspace& w) {
  State* const state = w.state.data();
  const NeighborListJob job = {
      .neighbor_list = w.neighbor_list.data(),
      .history = w.history.data(),
      .spheres = w.spheres.data(),
      .filter = filter_of(w.plan.test),
      .pairs = {w.pairs.data(), w.plan.capacity.pairs, &state->pairs},
      .uncertain_pairs = {w.uncertain_pairs.data(), w.plan.capacity.uncertain_pairs,
                          &state->uncertain_pairs},
      .state = state};
  const std::uint64_t most = w.allowed().near_room / kPerBlock + 1;
  neighbor_list_kernel<<<static_cast<unsigned>(std::min(most, kMostBlocks)), kBlockThreads, 0,
                         w.stream>>>(job);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom::coherence
