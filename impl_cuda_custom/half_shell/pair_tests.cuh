// SPDX-License-Identifier: MIT
// Stage 5 of half_shell: a thread a sphere, which meets the spheres of its runs one by one. Threads
// of a warp have spheres side by side, so their runs overlap, and what one loads the first-level
// cache holds for the others.
#pragma once

#include "impl_cuda_custom/half_shell/neighbours.cuh"
#include "impl_cuda_custom/pair_sinks.cuh"

namespace octocell::cuda_custom::half_shell {

struct TestJob {
  Shells shells;
  Band band;
  std::uint64_t candidate_limit;
  SinkArguments sink;

  /// The same for all threads: nothing that is read here changes in this stage.
  [[nodiscard]] __device__ bool may_test() const {
    return sink.state->violations == 0 && sink.state->candidates <= candidate_limit;
  }
  [[nodiscard]] __device__ bool is_sure(const Sphere& a, const Sphere& b) const {
    return band == Band::fast ? band_is_sure<Band::fast>(a, b) : band_is_sure<Band::safe>(a, b);
  }
};

/// A sphere as this stage sees it: in order, with its band radius.
struct Row {
  Sphere sphere;
  Object object;
};

/// Which of the 32 spheres from `begin` on, as far as `count`, may overlap the row's: one bit each.
/// `most`: the greatest count in the warp. A loop without votes; hits are rare and come after it.
__device__ inline std::uint32_t find_hits(const Sphere* spheres, const Sphere& row,
                                          std::uint32_t begin, std::uint32_t count,
                                          std::uint32_t most) {
  std::uint32_t hits = 0;
#pragma unroll 2
  for (std::uint32_t k = 0; k < most; ++k) {
    if (k < count && band_may_overlap(row, load_sphere(spheres, begin + k))) hits |= 1U << k;
  }
  return hits;
}

/// All lanes of the warp call it.
template <typename Sink>
__device__ void test_run(const TestJob& job, Sink& sink, const Row& row, Run run) {
  const std::uint32_t longest = __reduce_max_sync(kAllLanes, run.size());
  for (std::uint32_t done = 0; done < longest; done += kWarpThreads) {
    const std::uint32_t begin = run.begin + done;
    const std::uint32_t count = run.size() > done ? run.size() - done : 0;
    const std::uint32_t most = min(longest - done, std::uint32_t{kWarpThreads});
    std::uint32_t hits = find_hits(job.shells.spheres, row.sphere, begin, count, most);
    while (__any_sync(kAllLanes, hits != 0)) {
      const bool found = hits != 0;
      const std::uint32_t place = begin + (found ? __ffs(static_cast<int>(hits)) - 1 : 0);
      const Object other = found ? job.shells.objects[place] : 0;
      const bool sure = found && job.is_sure(row.sphere, load_sphere(job.shells.spheres, place));
      sink.take(sure, found && !sure, make_pair_of(row.object, other));
      hits &= hits - 1;
    }
  }
}

template <typename Sink>
__global__ void __launch_bounds__(kBlockThreads, Sink::kBlocksAtOnce)
    half_shell_kernel(const __grid_constant__ TestJob job) {
  __shared__ typename Sink::Shared shared;
  const auto entries = static_cast<std::uint32_t>(job.sink.state->entries);
  const std::uint32_t place = blockIdx.x * kBlockThreads + threadIdx.x;
  if (blockIdx.x * kBlockThreads >= entries || !job.may_test()) return;
  Sink sink(job.sink, shared);
  const bool present = place < entries;
  const Row row =
      present ? Row{load_sphere(job.shells.spheres, place), job.shells.objects[place]} : Row{};
  const std::uint32_t id = present ? job.shells.starts.cell_ids[place] : 0;
  visit_runs(job.shells, present, place, id, row.sphere,
             [&](Run run) { test_run(job, sink, row, run); });
  sink.close();
}

template <typename Sink>
void test_runs(Workspace& w) {
  State* const state = w.state.data();
  const TestJob job = {.shells = shells_of(w),
                       .band = w.plan.band,
                       .candidate_limit = w.plan.candidate_limit,
                       .sink = {.pairs = {w.pairs.data(), w.plan.capacity.pairs, &state->pairs},
                                .doubts = {w.doubts.data(), w.plan.capacity.doubts, &state->doubts},
                                .spheres = w.spheres.data(),
                                .state = state}};
  half_shell_kernel<Sink><<<blocks_for(w.sphere_count()), kBlockThreads, 0, w.stream>>>(job);
  cuda::check_launch();
}

inline void pair_tests(Workspace& w) {
  if (!w.half_shell()) return;
  if (w.plan.count_only) return test_runs<Count>(w);
  test_runs<Keep>(w);
}

}  // namespace octocell::cuda_custom::half_shell
