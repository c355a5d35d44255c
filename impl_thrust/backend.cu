// SPDX-License-Identifier: MIT
#include "impl_thrust/backend.hpp"

#include <thrust/functional.h>
#include <thrust/transform_reduce.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "core/error.hpp"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {
namespace {

struct Mix {
  OCTOCELL_HD std::uint64_t operator()(Pair pair) const { return mix_pair(pair); }
};

template <typename System>
class ThrustBackend final : public GridPairFinder {
 public:
  void upload(const Plan& plan, SceneView scene) override {
    w_.plan = plan;
    room_ = scene.spheres.size();
    w_.id_count = w_.cell_count = 0;
    w_.system.scratch().release();
    w_.levels = w_.system.take(w_.plan.levels);
    update(scene);
    w_.allocate();
  }

  /// Replaces the spheres. Nothing is kept between runs: every find_pairs() starts from them.
  void update(SceneView scene) override {
    if (scene.spheres.size() > room_) return upload(w_.plan, scene);
    w_.scene = scene;
    w_.spheres = w_.system.take(scene);
    w_.flags = w_.system.take_flags(scene);
  }

  std::unique_ptr<StageClock> make_clock(Marks marks) override {
    return w_.system.make_clock(marks);
  }

  Counts counts() override {
    Counts found;
    found.ids = w_.id_count;
    found.cells = w_.cell_count;
    found.candidates = w_.candidates;
    found.uncertain_pairs = w_.uncertain_count;
    found.pairs = w_.pair_count;
    found.over_candidate_limit = w_.candidates > w_.plan.candidate_limit;
    found.plan_violation = w_.violation;
    found.used = w_.used;
    if (kHostThreaded && std::is_same_v<System, HostSystem>) found.threads = threads_;
    return found;
  }

  std::vector<Pair> download() override {
    std::vector<Pair> pairs = w_.system.read(w_.pairs.data(), stored());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  /// Sorts and returns the pairs in place, if they are in the host's memory.
  std::span<const Pair> sorted_pairs() override {
    if constexpr (!std::is_same_v<System, HostSystem>) {
      return PairFinder::sorted_pairs();
    } else {
      std::sort(w_.pairs.data(), w_.pairs.data() + stored());
      return {w_.pairs.data(), stored()};
    }
  }

  /// Returns what Workspace::allocate() reserves, with the copy in which Thrust sorts.
  [[nodiscard]] HostBytes host_bytes(const Plan& plan, SceneView scene) const override {
    if (!std::is_same_v<System, HostSystem>) return {};
    constexpr double kEntry = sizeof(Object) + sizeof(Sphere) + sizeof(Found);
    constexpr double kId = kEntry + 5.0 * sizeof(std::uint32_t) + sizeof(Object);
    const double spheres = static_cast<double>(scene.spheres.size());
    if (plan.method == Method::brute_force) return {.fixed = kEntry * spheres, .per_pair = 8.0};
    return {.fixed = sizeof(std::uint64_t) * spheres,
            .per_id = kId,
            .per_cell = sizeof(CellEntry),
            .per_pair = sizeof(Pair)};
  }

  PairDigest digest() override {
    if (w_.plan.count_only) return {w_.pair_count, w_.checksum};
    const Pair* const pairs = w_.pairs.data();
    const std::uint64_t sum =
        thrust::transform_reduce(w_.system.policy(), pairs, pairs + stored(), Mix{},
                                 std::uint64_t{0}, thrust::plus<std::uint64_t>{});
    return {stored(), sum};
  }

 protected:
  Stages run(Stage stage, Stages left) override {
    switch (stage) {
      case Stage::bounds:
        w_.record = recording();
        threads_ = System::use_threads(w_.plan.threads);
        on_thrust::bounds(w_);
        return stages_after_bounds(w_.plan);
      case Stage::cell_ids:
        on_thrust::cell_ids(w_);
        break;
      case Stage::sort:
        on_thrust::sort(w_);
        break;
      case Stage::cell_index:
        on_thrust::cell_index(w_);
        break;
      case Stage::pair_tests:
        on_thrust::pair_tests(w_);
        break;
      case Stage::resolve:
        on_thrust::resolve(w_);
        break;
      default:
        break;
    }
    return left;
  }
  void write_down(Stage stage, RunRecord& record) override {
    on_thrust::write_down(w_, stage, record);
  }

 private:
  [[nodiscard]] std::uint64_t stored() const {
    return w_.plan.count_only || !w_.pairs_complete() ? 0 : w_.pair_count;
  }

  Workspace<System> w_;
  std::uint64_t room_ = 0;  // spheres that the arrays have room for
  int threads_ = 0;         // used by the last run
};

}  // namespace

std::unique_ptr<PairFinder> make_host_backend() {
  return std::make_unique<ThrustBackend<HostSystem>>();
}

#ifdef __CUDACC__

std::optional<std::string> why_no_cuda() { return cuda::why_no_device(); }

std::unique_ptr<PairFinder> make_cuda_backend() {
  if (const auto reason = why_no_cuda()) throw Error(*reason);
  return std::make_unique<ThrustBackend<CudaSystem>>();
}

#else

std::optional<std::string> why_no_cuda() { return "built without nvcc"; }
std::unique_ptr<PairFinder> make_cuda_backend() { throw Error(*why_no_cuda()); }

#endif

}  // namespace octocell::on_thrust
