// SPDX-License-Identifier: MIT
#include "impl_cuda_custom/backend.hpp"

#include "core/error.hpp"

#ifdef __CUDACC__

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/flags.hpp"
#include "core/planner/scene_stats.hpp"
#include "impl_cuda_custom/coherence/coherence.cuh"
#include "impl_cuda_custom/device.cuh"
#include "impl_cuda_custom/device_runs.cuh"
#include "impl_cuda_custom/tiles/tiles.cuh"

namespace octocell::cuda_custom {
namespace {

__global__ void __launch_bounds__(kBlockThreads)
    checksum_kernel(const Pair* pairs, std::uint64_t count, std::uint64_t* checksum) {
  const std::uint64_t stride = std::uint64_t{gridDim.x} * kBlockThreads;
  std::uint64_t sum = 0;
  for (std::uint64_t k = std::uint64_t{blockIdx.x} * kBlockThreads + threadIdx.x; k < count;
       k += stride) {
    sum += mix_pair(pairs[k]);
  }
  add_over_block(checksum, sum);
}

class CudaBackend final : public GridPairFinder {
 public:
  CudaBackend() {
    cuda::check(cudaStreamCreateWithFlags(&w_.stream, cudaStreamNonBlocking));
    state_.allocate(1);
    w_.mode_taken.allocate(1);
  }
  CudaBackend(const CudaBackend&) = delete;
  CudaBackend& operator=(const CudaBackend&) = delete;
  ~CudaBackend() override { cudaStreamDestroy(w_.stream); }

  void upload(const Plan& plan, SceneView scene) override {
    runs_.forget_graph();
    room_ = scene.spheres.size();
    w_.plan = plan;
    w_.scene = scene;
    w_.sorter.reset();
    if (plan.method == Method::home_phantom) {
      w_.sorter.emplace(Variant::onesweep, plan.capacity.ids, plan.key_bits);
    }
    if (w_.half_shell()) {  // its own kernel counts digits, so there must be one
      w_.sorter.emplace(Variant::onesweep, plan.capacity.ids, std::max(plan.key_bits, 1));
    }
    w_.grown_sorter.reset();
    if (plan.moving && plan.skin.growth > 0.0F && w_.half_shell()) {  // flags are not considered:
                                                                      // they may change later
      w_.grown_sorter.emplace(Variant::onesweep, plan.capacity.ids,
                              std::max(plan.skin.key_bits, 1));
    }
    coherence_.flags_differ(w_);
    make_room();
    if (w_.tiles()) tiles::prepare(w_);
    coherence_.reset(w_);
    update(scene);
  }

  /// Replaces the spheres. Data of the last frame is reused only if the device has proved that it
  /// is still right.
  void update(SceneView scene) override {
    if (scene.spheres.size() > room_) return upload(w_.plan, scene);
    const bool sizes_as_before = scene.spheres.size() == w_.scene.spheres.size() &&
                                 scene.flags.size() == w_.scene.flags.size();
    if (!sizes_as_before) runs_.forget_graph();  // the graph holds the arrays' addresses
    w_.scene = scene;
    if (w_.plan.moving && coherence_.flags_differ(w_)) {
      runs_.forget_graph();
      make_room();
      coherence_.forget(w_);
    }
    w_.spheres.allocate(scene.spheres.size());
    w_.flags.allocate(scene.flags.size());
    // Checked here, where the flags are on the host: one pass, and only if the plan needs it.
    flags_broken_ = w_.plan.nothing_to_find && some_may_collide(scene.flags);
    if (scene.spheres.empty()) return;
    cuda::check(cudaMemcpyAsync(w_.spheres.data(), scene.spheres.data(), scene.spheres.size_bytes(),
                                cudaMemcpyHostToDevice, w_.stream));
    if (!scene.flags.empty()) {
      cuda::check(cudaMemcpyAsync(w_.flags.data(), scene.flags.data(), scene.flags.size_bytes(),
                                  cudaMemcpyHostToDevice, w_.stream));
    }
    wait();
  }

  std::unique_ptr<StageClock> make_clock(Marks marks) override {
    return std::make_unique<cuda::EventClock>(w_.stream, marks);
  }

  Counts counts() override {
    State state = read_state();
    if (coherence_.looked_at_too_many(w_, state)) {  // the exact number of candidates may still be
                                                     // within the limit
      HostClock unread(Marks::off);
      find_pairs(unread);
      state = read_state();
    }
    coherence_.learn(w_, state);
    Counts found;
    found.ids = state.ids;
    found.cells = state.cells;
    found.candidates = state.candidates;
    found.uncertain_pairs = state.uncertain_pairs;
    found.pairs = state.pairs;
    found.tile_records = state.tile_records;
    found.over_candidate_limit =
        state.mode == FrameMode::search && state.candidates > w_.plan.candidate_limit;
    found.plan_violation = words_for(state.violations);
    found.reused = skip_of(state.mode);
    if (found.reused) found.used = found.used.with(*found.reused);
    const bool sorted_ids = w_.half_shell() && !found.reused && state.entries > 0;
    if (sorted_ids && state.out_of_order == 0) found.used = found.used.with(Skip::sort);
    return found;
  }

  std::vector<Pair> download() override {
    std::vector<Pair> pairs(stored(read_state()));
    if (pairs.empty()) return pairs;
    cuda::check(cudaMemcpyAsync(pairs.data(), w_.pairs.data(), pairs.size() * sizeof(Pair),
                                cudaMemcpyDeviceToHost, w_.stream));
    wait();
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  PairDigest digest() override {
    const State state = read_state();
    if (w_.plan.count_only) return {state.pairs, state.checksum};
    const std::uint64_t count = stored(state);
    if (count == 0) return {};
    constexpr std::uint64_t kMostBlocks = 2048;
    const auto blocks =
        static_cast<unsigned>(std::min<std::uint64_t>(blocks_for(count), kMostBlocks));
    std::uint64_t* const checksum = &w_.state.data()->checksum;
    cuda::check(cudaMemsetAsync(checksum, 0, sizeof *checksum, w_.stream));
    checksum_kernel<<<blocks, kBlockThreads, 0, w_.stream>>>(w_.pairs.data(), count, checksum);
    cuda::check_launch();
    return {count, read_state().checksum};
  }

  DeviceRuns* device_runs() override { return &runs_; }

 protected:
  Stages run(Stage stage, Stages left) override {
    switch (stage) {
      case Stage::bounds:
        w_.record = recording();
        cuda_custom::bounds(w_);
        return predicted_stages();
      case Stage::cell_ids:
        cuda_custom::cell_ids(w_);
        break;
      case Stage::sort:
        cuda_custom::sort(w_);
        break;
      case Stage::cell_index:
        cuda_custom::cell_index(w_);
        break;
      case Stage::pair_tests:
        cuda_custom::pair_tests(w_);
        break;
      case Stage::resolve:
        cuda_custom::resolve(w_);
        break;
      default:
        break;
    }
    return left;
  }
  void write_down(Stage stage, RunRecord& record) override {
    cuda_custom::write_down(w_, stage, record);
  }
  [[nodiscard]] bool bounds_with_cell_ids() const override { return w_.half_shell() || w_.tiles(); }
  /// Returns the stages that should have been queued. The host reads them while the device
  /// continues with the queued work.
  Stages missed_stages() override {
    if (!w_.mode) return {};
    opened_.wait();
    const FrameMode queued = *w_.mode;
    w_.mode = *w_.mode_taken.data();
    if (*w_.mode == queued) return {};
    return stages_after_bounds(w_.plan, *w_.mode);
  }

 private:
  /// Predicts that the frame has the mode of the last one.
  Stages predicted_stages() {
    w_.mode.reset();
    if (w_.coherent() && !is_recorded()) w_.mode = coherence_.predicted();
    if (w_.mode) opened_.record(w_.stream);
    return stages_after_bounds(w_.plan, w_.mode.value_or(FrameMode::search));
  }

  /// Checks that all arrays fit before it frees any of them.
  void make_room() {
    std::uint64_t more = 0;
    w_.for_each_array([&](auto& array, std::uint64_t elements) {
      if (elements > array.capacity()) more += (elements - array.capacity()) * array.kElementBytes;
    });
    cuda::require_memory(more);
    w_.for_each_array([](auto& array, std::uint64_t elements) { array.allocate(elements); });
  }

  void wait() { cuda::check(cudaStreamSynchronize(w_.stream)); }

  State read_state() {
    cuda::check(cudaMemcpyAsync(state_.data(), w_.state.data(), sizeof(State),
                                cudaMemcpyDeviceToHost, w_.stream));
    wait();
    return *state_.data();
  }

  /// Returns true while a graph is recorded: what the device finds now says nothing about later
  /// frames.
  [[nodiscard]] bool is_recorded() const {
    cudaStreamCaptureStatus status = cudaStreamCaptureStatusNone;
    cuda::check(cudaStreamIsCapturing(w_.stream, &status));
    return status != cudaStreamCaptureStatusNone;
  }

  [[nodiscard]] std::uint64_t stored(const State& state) const {
    return w_.plan.count_only || state.pairs > w_.plan.capacity.pairs ? 0 : state.pairs;
  }

  /// Returns the message for violations. The device only sets flags; the text, which names a
  /// sphere, is made here.
  [[nodiscard]] std::optional<std::string> words_for(std::uint32_t violations) const {
    if ((violations & kInvalidSphere) != 0) return describe_first_invalid(w_.scene.spheres);
    if ((violations & kOutsidePlan) != 0) {
      return kFactsBroken;
    }
    if ((violations & kThreeCells) != 0) {
      return chapter32::kMeetsThreeCells;
    }
    if (flags_broken_) return kFlagsBroken;
    return std::nullopt;
  }

  Workspace w_;
  std::uint64_t room_ = 0;    // spheres that the arrays have room for
  PinnedArray<State> state_;  // [1], read from the device
  cuda::Event opened_;        // recorded after the first kernel of a frame
  coherence::Coherence coherence_;
  bool flags_broken_ = false;  // the plan does not hold for these flags
  CudaDeviceRuns runs_{*this, w_};
};

}  // namespace

std::optional<std::string> why_unavailable() { return cuda::why_no_device(); }

std::unique_ptr<PairFinder> make_backend() {
  if (const auto reason = why_unavailable()) throw Error(*reason);
  return std::make_unique<CudaBackend>();
}

}  // namespace octocell::cuda_custom

#else

namespace octocell::cuda_custom {

std::optional<std::string> why_unavailable() { return "built without nvcc"; }
std::unique_ptr<PairFinder> make_backend() { throw Error(*why_unavailable()); }

}  // namespace octocell::cuda_custom

#endif
