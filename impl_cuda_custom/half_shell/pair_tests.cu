// SPDX-License-Identifier: MIT
// Stage 5 of half_shell: one thread for each sphere, which is tested against the spheres of its
// runs one by one. The threads of a warp have neighbouring spheres, so their runs overlap, and what
// one thread loads is in the first-level cache for the others.
#include "impl_cuda_custom/half_shell/pair_tests.cuh"

#include <cstdint>

#include "impl_cuda_custom/coherence/neighbor_list.cuh"
#include "impl_cuda_custom/half_shell/neighbours.cuh"
#include "impl_cuda_custom/pair_sinks.cuh"
#include "impl_cuda_custom/pair_test.cuh"

namespace octocell::cuda_custom::half_shell {
namespace {

/// `Stored`: the type of sorted sphere that the test reads.
template <typename Neighbours, typename Test, typename Stored>
struct TestJob {
  Neighbours neighbours;
  Test test;
  const Stored* stored;
  std::uint64_t candidate_limit;
  SinkArguments sink;

  /// Returns the same for all threads: nothing that it reads changes in this stage.
  [[nodiscard]] __device__ bool may_test() const {
    return sink.state->violations == 0 && sink.state->candidates <= candidate_limit;
  }
};

/// Two places of the sorted spheres.
struct Hit {
  std::uint32_t row;
  std::uint32_t other;
};

/// Collects the hits of a warp until there is one for each lane. Few lanes have a hit at the same
/// time, but the warp would spend the same time on one hit as on 32.
template <typename Sink, typename Job>
class HitQueue {
 public:
  struct Shared {
    Hit hits[kBlockWarps][2 * kWarpThreads];
  };
  __device__ HitQueue(const Job& job, Sink& sink, Shared& shared)
      : job_(job), sink_(sink), hits_(shared.hits[warp()]) {}

  /// Appends the hits of those lanes that `have` one. All lanes of the warp must call it.
  __device__ void push(bool have, Hit hit) {
    const unsigned having = __ballot_sync(kAllLanes, have);
    if (have) hits_[size_ + __popc(having & lanes_below())] = hit;
    size_ += __popc(having);
    if (size_ >= kWarpThreads) drain();
  }

  /// Passes up to 32 hits to the sink.
  __device__ void drain() {
    __syncwarp();  // makes the stores of other lanes visible
    const int count = min(size_, kWarpThreads);
    size_ -= count;
    const bool mine = lane() < count;
    Pair pair = {};
    Verdict verdict = Verdict::apart;
    if (mine) {
      const Hit hit = hits_[size_ + lane()];
      const Sphere* const spheres = job_.neighbours.spheres;
      const Object* const objects = job_.neighbours.objects;
      verdict = job_.test.verdict_on(load(spheres, hit.row), load(spheres, hit.other));
      pair = make_pair_of(objects[hit.row], objects[hit.other]);
    }
    sink_.take(verdict, pair);
    __syncwarp();  // the next push may overwrite the places
  }

 private:
  const Job& job_;
  Sink& sink_;
  Hit* const hits_;
  int size_ = 0;  // the same in all lanes
};

/// Returns which of the `count` spheres from `others` on may overlap `row`, one bit each. `count`
/// is at most 32 and the same in all lanes, so there is no branch after each sphere. A lane may
/// read beyond its own run, by at most kReadBehind spheres.
template <typename Test, typename Stored>
__device__ inline std::uint32_t find_hits(const Test& test, const Stored& row, const Stored* others,
                                          std::uint32_t count) {
  constexpr int kAtOnce = 3;  // more need so many registers that fewer blocks fit
  std::uint32_t hits = 0;
#pragma unroll 1
  for (std::uint32_t k = 0; k < count; k += kAtOnce) {
    Stored other[kAtOnce];
#pragma unroll
    for (int j = 0; j < kAtOnce; ++j) other[j] = load(others, j);
    std::uint32_t here = 0;
#pragma unroll
    for (int j = 0; j < kAtOnce; ++j) {
      if (test.may_overlap(row, other[j])) here |= 1U << j;
    }
    hits |= here << k;
    others += kAtOnce;
  }
  return hits;
}

/// Tests the lane's own run. All lanes of the warp must call it.
template <typename Job, typename Queue, typename Stored>
__device__ void test_run(const Job& job, Queue& queue, std::uint32_t place, const Stored& row,
                         IndexRange run) {
  const std::uint32_t longest = max_over_warp(run.size());
  for (std::uint32_t done = 0; done < longest; done += kWarpThreads) {
    const std::uint32_t left = run.size() > done ? run.size() - done : 0;
    const std::uint32_t begin = left != 0 ? run.begin + done : 0;
    std::uint32_t hits = find_hits(job.test, row, job.stored + begin,
                                   min(longest - done, std::uint32_t{kWarpThreads}));
    if (left < kWarpThreads) hits &= (1U << left) - 1;
    while (__any_sync(kAllLanes, hits != 0)) {
      queue.push(hits != 0, {place, begin + __ffs(static_cast<int>(hits)) - 1});
      hits &= hits - 1;
    }
  }
}

template <typename Sink, typename Neighbours, typename Test, typename Stored>
__global__ void __launch_bounds__(kBlockThreads, Sink::kBlocksAtOnce)
    half_shell_kernel(const __grid_constant__ TestJob<Neighbours, Test, Stored> job) {
  using Queue = HitQueue<Sink, TestJob<Neighbours, Test, Stored>>;
  __shared__ typename Sink::Shared shared;
  __shared__ typename Queue::Shared queued;
  const auto entries = static_cast<std::uint32_t>(job.sink.state->entries);
  const std::uint32_t place = blockIdx.x * kBlockThreads + threadIdx.x;
  if (blockIdx.x * kBlockThreads >= entries || !job.may_test()) return;
  Sink sink(job.sink, shared);
  Queue queue(job, sink, queued);
  const Neighbours& neighbours = job.neighbours;
  const bool present = place < entries;
  const Sphere sphere = present ? load(neighbours.spheres, place) : Sphere{};
  const Stored row = present ? load(job.stored, place) : Stored{};
  const std::uint32_t id = present ? neighbours.starts.cell_ids[place] : 0;
  neighbours.visit_runs(present, place, id, sphere,
                        [&](IndexRange run) { test_run(job, queue, place, row, run); });
  queue.drain();
  sink.close();
}

template <typename Sink, typename Test, typename Stored>
void test_runs(Workspace& w, const Test& test, const Stored* stored, const SinkArguments& sink) {
  const std::uint64_t count = w.sphere_count();
  const unsigned blocks = blocks_for(count);
  with_neighbours(w, [&](const auto& neighbours) {
    const TestJob job = {.neighbours = neighbours,
                         .test = test,
                         .stored = stored,
                         .candidate_limit = w.plan.candidate_limit,
                         .sink = sink};
    half_shell_kernel<Sink><<<blocks, kBlockThreads, 0, w.stream>>>(job);
    cuda::check_launch();
  });
}

}  // namespace

void pair_tests(Workspace& w) {
  if (!w.half_shell()) return;
  const Packing& packing = w.plan.packing;
  const Sphere* const spheres = w.sorted_spheres.data();
  SinkArguments sink = sink_arguments_of(w);
  if (w.plan.count_only) {
    return test_runs<Count>(w, AnyTest{w.plan.test, packing}, spheres, sink);
  }
  if (w.grows()) {
    sink.neighbor_list = coherence::near_list(w);
    sink.filter = filter_of(w.plan.test);
    const FixedTest<PairTest::filter_safe> of_grown = {};
    return test_runs<coherence::KeepNear>(w, of_grown, spheres, sink);
  }
  with_pair_test(w.plan.test, [&]<PairTest asked>() {
    // Radii are loaded together with coordinates. Knowing that they are equal saves no load and
    // costs a register.
    constexpr PairTest test = asked == PairTest::filter_equal ? PairTest::filter_fast : asked;
    const FixedTest<test> fixed = {packing};
    if constexpr (is_packed(test)) {
      test_runs<Keep>(w, fixed, w.sorted_packed.data(), sink);
    } else {
      test_runs<Keep>(w, fixed, spheres, sink);
    }
  });
}

}  // namespace octocell::cuda_custom::half_shell
