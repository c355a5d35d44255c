// SPDX-License-Identifier: MIT
#include "impl_cpu/backend.hpp"

#include <algorithm>

#include "impl_cpu/stages.hpp"

namespace octocell::cpu {
namespace {

class CpuBackend final : public GridPairFinder {
 public:
  void upload(const Plan& plan, SceneView scene) override {
    w_.plan = plan;
    w_.scene = scene;
    w_.id_count = 0;
    w_.cells.clear();
    if (!w_.threads || w_.threads->count() != plan.threads) {
      w_.threads = std::make_unique<Threads>(plan.threads);
    }
    w_.allocate();
  }

  /// Nothing stands between runs: every find_pairs() starts from the spheres.
  void update(SceneView scene) override { w_.scene = scene; }

  Counts counts() override {
    Counts found;
    found.ids = w_.id_count;
    found.cells = w_.plan.method == Method::half_shell ? w_.ordered.row_count : w_.cells.size();
    found.candidates = w_.candidates;
    found.doubts = w_.doubts.size();
    found.pairs = w_.pairs.size();
    found.over_candidate_limit = w_.candidates > w_.plan.candidate_limit;
    found.plan_violation = w_.violation;
    found.used = w_.used;
    return found;
  }

  std::vector<Pair> download() override {
    const std::span<const Pair> found = w_.pairs.items();
    std::vector<Pair> pairs(found.begin(), found.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  PairDigest digest() override { return w_.pairs.digest(); }

 protected:
  [[nodiscard]] Method method() const override { return w_.plan.method; }
  void bounds() override { cpu::bounds(w_); }
  void cell_ids() override { cpu::cell_ids(w_); }
  void sort() override { cpu::sort(w_); }
  void cell_index() override { cpu::cell_index(w_); }
  void pair_tests() override { cpu::pair_tests(w_); }
  void resolve() override { cpu::resolve(w_); }

 private:
  Workspace w_;
};

}  // namespace

std::unique_ptr<PairFinder> make_backend() { return std::make_unique<CpuBackend>(); }

}  // namespace octocell::cpu
