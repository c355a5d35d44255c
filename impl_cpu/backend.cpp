// SPDX-License-Identifier: MIT
#include "impl_cpu/backend.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "impl_cpu/coherence/coherence.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {
namespace {

class CpuBackend final : public GridPairFinder {
 public:
  void upload(const Plan& plan, SceneView scene) override {
    w_.plan = plan;
    w_.scene = scene;
    room_ = scene.spheres.size();
    w_.id_count = 0;
    w_.cells.clear();
    if (!w_.threads || w_.threads->asked() != plan.threads) {
      w_.threads = std::make_shared<Threads>(plan.threads);
      w_.threads->stop_when(stop_wanted_);
    }
    w_.allocate();
    coherence_.reset(w_);
    flags_.assign(scene.flags.begin(), scene.flags.end());
  }

  /// Replaces the spheres. Data of the last frame is reused only if coherence_ has proved that it
  /// is still right.
  void update(SceneView scene) override {
    if (scene.spheres.size() > room_) return upload(w_.plan, scene);
    if (!std::ranges::equal(flags_, scene.flags)) {
      flags_.assign(scene.flags.begin(), scene.flags.end());
      coherence_.forget();  // Coherence compares only
                            // spheres
    }
    w_.scene = scene;
  }

  void stop_when(std::function<bool()> wanted) override {
    stop_wanted_ = std::move(wanted);
    if (w_.threads) w_.threads->stop_when(stop_wanted_);
  }

  Counts counts() override {
    Counts found;
    if (stages_after_bounds(w_.plan, coherence_.mode()).has(Stage::cell_ids)) {
      count_cells(coherence_.ordered_now(w_), found);
    }
    found.candidates = w_.candidates;
    found.uncertain_pairs = w_.uncertain_pairs.size();
    found.pairs = w_.pairs.size();
    found.over_candidate_limit = w_.candidates > w_.plan.candidate_limit;
    found.reused = skip_of(coherence_.mode());
    found.plan_violation = w_.violation;
    found.used = w_.used;
    found.threads = w_.threads->count();
    if (found.reused) found.used = found.used.with(*found.reused);
    return found;
  }

  std::vector<Pair> download() override {
    const std::span<const Pair> found = sorted_pairs();
    return {found.begin(), found.end()};
  }

  std::span<const Pair> sorted_pairs() override {
    const std::span<Pair> found = w_.pairs.stored();
    std::sort(found.begin(), found.end());
    return found;
  }

  std::span<const Pair> pairs() override { return w_.pairs.stored(); }

  /// Allocates the next run's list at once, because counts are compared with the plan's capacity.
  OwnedPairs take_pairs() override {
    coherence_.forget();
    Buffer<Pair> next;
    next.allocate(w_.plan.capacity.pairs);
    const std::uint64_t count = w_.pairs.stored().size();
    return {w_.pairs.exchange(std::move(next)), count};
  }

  [[nodiscard]] HostBytes host_bytes(const Plan& plan, SceneView scene) const override {
    return bytes_of(plan, scene.spheres.size());
  }

  PairDigest digest() override { return w_.pairs.digest(); }

 protected:
  Stages run(Stage stage, Stages left) override {
    switch (stage) {
      case Stage::bounds:
        w_.record = recording();
        coherence_.bounds(w_);
        return stages_after_bounds(w_.plan, coherence_.mode());
      case Stage::cell_ids:
        cpu::cell_ids(coherence_.ordered_now(w_));
        break;
      case Stage::sort:
        cpu::sort(coherence_.ordered_now(w_));
        break;
      case Stage::cell_index:
        cpu::cell_index(coherence_.ordered_now(w_));
        break;
      case Stage::pair_tests:
        return coherence_.pair_tests(w_) ? left : stages_after_bounds(w_.plan);
      case Stage::resolve:
        coherence_.resolve(w_);
        break;
      default:
        break;
    }
    return left;
  }
  void write_down(Stage stage, RunRecord& record) override { cpu::write_down(w_, stage, record); }

 private:
  static void count_cells(const Workspace& w, Counts& found) {
    found.ids = w.id_count;
    found.cells = w.plan.method == Method::half_shell ? w.ordered.row_count : w.cells.size();
  }

  std::function<bool()> stop_wanted_;
  Workspace w_;
  std::uint64_t room_ = 0;    // spheres that the buffers have room for
  std::vector<Flags> flags_;  // of the scene
  coherence::Coherence coherence_;
};

}  // namespace

std::unique_ptr<PairFinder> make_backend() { return std::make_unique<CpuBackend>(); }

}  // namespace octocell::cpu
