// SPDX-License-Identifier: MIT
// Further runs for the bench: with a cold cache, as a graph, with transfers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/finder.hpp"
#include "impl_cuda_custom/pinned_array.cuh"
#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom {

class CudaDeviceRuns final : public DeviceRuns {
 public:
  CudaDeviceRuns(PairFinder& finder, Workspace& workspace) : finder_(finder), w_(workspace) {}
  CudaDeviceRuns(const CudaDeviceRuns&) = delete;
  CudaDeviceRuns& operator=(const CudaDeviceRuns&) = delete;
  ~CudaDeviceRuns() override { forget_graph(); }

  void flush_cache() override {
    flushed_.allocate(kFlushedBytes);
    cuda::check(cudaMemsetAsync(flushed_.data(), 0, kFlushedBytes, w_.stream));
    cuda::check(cudaStreamSynchronize(w_.stream));
  }

  double replay_ms() override {
    if (graph_ == nullptr) record();
    cuda::EventClock clock(w_.stream, Marks::off);
    clock.start();
    cuda::check(cudaGraphLaunch(graph_, w_.stream));
    return clock.stop().total_ms;
  }

  double transfers_ms() override {
    const std::size_t sphere_bytes = w_.scene.spheres.size_bytes();
    if (sphere_bytes == 0) return 0.0;
    pinned_spheres_.allocate(w_.scene.spheres.size());
    std::copy(w_.scene.spheres.begin(), w_.scene.spheres.end(), pinned_spheres_.data());
    pinned_pairs_.allocate(w_.plan.capacity.pairs);
    pinned_state_.allocate(1);

    cuda::EventClock clock(w_.stream, Marks::off);
    clock.start();
    copy(w_.spheres.data(), pinned_spheres_.data(), sphere_bytes);
    Silence silence;
    finder_.find_pairs(silence);
    copy(pinned_state_.data(), w_.state.data(), sizeof(State));
    cuda::check(cudaStreamSynchronize(w_.stream));  // the number of pairs must be known to fetch
                                                    // them
    const std::uint64_t pairs = std::min(pinned_state_.data()->pairs, w_.plan.capacity.pairs);
    if (!w_.plan.count_only) copy(pinned_pairs_.data(), w_.pairs.data(), pairs * sizeof(Pair));
    return clock.stop().total_ms;
  }

  /// Drops the recorded graph. Must be called before any array moves that the graph points to.
  void forget_graph() {
    if (graph_ != nullptr) cudaGraphExecDestroy(graph_);
    graph_ = nullptr;
  }

 private:
  static constexpr std::uint64_t kFlushedBytes = std::uint64_t{256}
                                                 << 20;  // five caches of an H100

  /// A clock without events: while a graph is recorded, they would become part of it.
  struct Silence final : StageClock {
    void start() override {}
    void mark(Stage, Stage) override {}
    StageTimes stop() override { return {}; }
  };

  void record() {
    cudaGraph_t graph = nullptr;
    cuda::check(cudaStreamBeginCapture(w_.stream, cudaStreamCaptureModeThreadLocal));
    Silence silence;
    finder_.find_pairs(silence);
    cuda::check(cudaStreamEndCapture(w_.stream, &graph));
    const cudaError_t result = cudaGraphInstantiate(&graph_, graph, 0);
    cudaGraphDestroy(graph);
    cuda::check(result);
  }

  void copy(void* to, const void* from, std::size_t bytes) {
    if (bytes == 0) return;
    cuda::check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, w_.stream));
  }

  PairFinder& finder_;
  Workspace& w_;
  cudaGraphExec_t graph_ = nullptr;
  cuda::DeviceArray<char> flushed_;
  PinnedArray<Sphere> pinned_spheres_;
  PinnedArray<Pair> pinned_pairs_;
  PinnedArray<State> pinned_state_;
};

}  // namespace octocell::cuda_custom
