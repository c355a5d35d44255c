// SPDX-License-Identifier: MIT
// Stage 6, resolve: decide the uncertain pairs.
// Reads uncertain pairs, spheres. Writes pairs, behind the certain ones.
// Cost: a few uncertain pairs in a million pairs, but all pairs of a lattice of tangent spheres.
// Idea: float64 with an error bound, error-free transformations, integers: the first that is
//       certain decides. A kernel of its own keeps its registers out of stage 5.
#include <algorithm>
#include <cstdint>

#include "impl_cuda_custom/exact.cuh"
#include "impl_cuda_custom/pair_writer.cuh"

namespace octocell::cuda_custom {
namespace {

constexpr std::uint64_t kMostBlocks = 2048;

__global__ void __launch_bounds__(kBlockThreads)
    resolve_kernel(const Pair* uncertain_pairs, std::uint64_t capacity, const Sphere* spheres,
                   PairList pairs, const State* state) {
  __shared__ PairWriter::Shared shared;
  const std::uint64_t count = state->uncertain_pairs;
  if (count > capacity) return;  // some were not stored; the next plan has room for all
  PairWriter writer(pairs, shared);
  const std::uint64_t stride = std::uint64_t{gridDim.x} * kBlockThreads;
  std::uint64_t begin = std::uint64_t{blockIdx.x} * kBlockThreads;
  if (begin >= count) return;
  for (; begin < count; begin += stride) {
    const std::uint64_t d = begin + threadIdx.x;
    const Pair pair = d < count ? uncertain_pairs[d] : Pair{};
    writer.push(d < count && overlap(spheres, pair), pair);
  }
  writer.close();
}

}  // namespace

void resolve(Workspace& w) {
  const std::uint64_t room = w.plan.capacity.uncertain_pairs;
  if (w.plan.count_only || room == 0) return;  // stage 5 has already decided them
  State* const state = w.state.data();
  const auto blocks = static_cast<unsigned>(std::min<std::uint64_t>(blocks_for(room), kMostBlocks));
  resolve_kernel<<<blocks, kBlockThreads, 0, w.stream>>>(
      w.uncertain_pairs.data(), room, w.spheres.data(),
      {w.pairs.data(), w.plan.capacity.pairs, &state->pairs}, state);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom
