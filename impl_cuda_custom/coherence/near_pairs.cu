// SPDX-License-Identifier: MIT
// Which near pairs overlap now? They were listed cell by cell, and all spheres fit into the cache
// of a large device, so spheres are read where they are.
#include "impl_cuda_custom/coherence/near_pairs.cuh"

#include <algorithm>
#include <cstdint>

#include "impl_cuda_custom/coherence/frames.cuh"

namespace octocell::cuda_custom::coherence {
namespace {

constexpr int kAtOnce = 2;  // near pairs of a thread under way
constexpr std::uint32_t kPerBlock = kBlockThreads * kAtOnce;
constexpr std::uint64_t kMostBlocks = 792;

struct Job {
  const Pair* near_pairs;
  const Kept* kept;
  const Sphere* spheres;
  Band band;
  PairList pairs;
  PairList doubts;
  const State* state;
};

__global__ void __launch_bounds__(kBlockThreads, 6) near_pairs_kernel(Job job) {
  __shared__ PairWriter::Shared shared_pairs;
  __shared__ PairWriter::Shared shared_doubts;
  if (job.state->course != Course::near_pairs) return;
  const std::uint64_t count = job.kept->near_pairs;
  PairWriter pairs(job.pairs, shared_pairs);
  PairWriter doubts(job.doubts, shared_doubts);
  const std::uint64_t stride = std::uint64_t{gridDim.x} * kPerBlock;
  for (std::uint64_t begin = std::uint64_t{blockIdx.x} * kPerBlock; begin < count;
       begin += stride) {
    Pair near[kAtOnce] = {};
    Verdict verdicts[kAtOnce];
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {
      const std::uint64_t place = begin + k * kBlockThreads + threadIdx.x;
      if (place >= count) break;
      const uint2 pair = __ldg(reinterpret_cast<const uint2*>(job.near_pairs) + place);
      near[k] = {pair.x, pair.y};
    }
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {  // beyond the end stands {0, 0}, and is not asked for
      verdicts[k] = test_in_float32(job.band, load_sphere(job.spheres, near[k].i),
                                    load_sphere(job.spheres, near[k].j));
    }
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {
      const bool present = begin + k * kBlockThreads + threadIdx.x < count;
      pairs.push(present && verdicts[k] == Verdict::overlap, near[k]);
      doubts.push(present && verdicts[k] == Verdict::doubt, near[k]);
    }
  }
  pairs.close();
  doubts.close();
}

}  // namespace

void test_near_pairs(Workspace& w) {
  State* const state = w.state.data();
  const Job job = {.near_pairs = w.near_pairs.data(),
                   .kept = w.kept.data(),
                   .spheres = w.spheres.data(),
                   .band = band_of(w.plan.test),
                   .pairs = {w.pairs.data(), w.plan.capacity.pairs, &state->pairs},
                   .doubts = {w.doubts.data(), w.plan.capacity.doubts, &state->doubts},
                   .state = state};
  const std::uint64_t most = w.allowed().near_room / kPerBlock + 1;
  near_pairs_kernel<<<static_cast<unsigned>(std::min(most, kMostBlocks)), kBlockThreads, 0,
                      w.stream>>>(job);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom::coherence
