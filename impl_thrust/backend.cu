// SPDX-License-Identifier: MIT
#include "impl_thrust/backend.hpp"

#include <thrust/functional.h>
#include <thrust/transform_reduce.h>

#include <algorithm>

#include "harness/interface/error.hpp"
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
    w_.id_count = w_.cell_count = 0;
    w_.system.scratch().release();
    w_.levels = w_.system.take(w_.plan.levels);
    update(scene);
    w_.allocate();
  }

  /// Nothing stands between runs: every find_pairs() starts from the spheres.
  void update(SceneView scene) override {
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
    found.doubts = w_.doubt_count;
    found.pairs = w_.pair_count;
    found.over_candidate_limit = w_.candidates > w_.plan.candidate_limit;
    found.plan_violation = w_.violation;
    found.used = w_.used;
    return found;
  }

  std::vector<Pair> download() override {
    std::vector<Pair> pairs = w_.system.read(w_.pairs.data(), stored());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
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
  [[nodiscard]] Method method() const override { return w_.plan.method; }
  [[nodiscard]] bool nothing_to_find() const override { return w_.plan.nothing_to_find; }
  void bounds() override {
    System::use_threads(w_.plan.threads);
    on_thrust::bounds(w_);
  }
  void cell_ids() override { on_thrust::cell_ids(w_); }
  void sort() override { on_thrust::sort(w_); }
  void cell_index() override { on_thrust::cell_index(w_); }
  void pair_tests() override { on_thrust::pair_tests(w_); }
  void resolve() override { on_thrust::resolve(w_); }

 private:
  [[nodiscard]] std::uint64_t stored() const {
    return w_.plan.count_only || !w_.pairs_complete() ? 0 : w_.pair_count;
  }

  Workspace<System> w_;
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
