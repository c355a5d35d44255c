// SPDX-License-Identifier: MIT
#include "harness/engine/plugin_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/flags.hpp"

namespace octocell {
namespace {

class PluginFinder final : public PairFinder {
 public:
  explicit PluginFinder(std::shared_ptr<const PluginLibrary> library)
      : library_(std::move(library)) {}
  PluginFinder(const PluginFinder&) = delete;
  PluginFinder& operator=(const PluginFinder&) = delete;
  ~PluginFinder() override { let_go(); }

  void upload(const Plan& plan, SceneView scene) override {
    let_go();
    scene_ = scene;
    stores_pairs_ = !plan.count_only;
    library_->prepare(scene.spheres.size());
    is_prepared_ = true;
    room_ = PairRoom(plan.capacity.pairs);
  }

  void update(SceneView scene) override { scene_ = scene; }

  void find_pairs(StageClock& clock) override {
    clock.start();
    count_ = library_->find(scene_.spheres, room_);
    // A plan that stores no pairs has no room for them, but a plug-in cannot count without.
    if (!stores_pairs_ && count_ > room_.capacity()) {
      room_ = PairRoom(count_);
      count_ = library_->find(scene_.spheres, room_);
    }
    clock.mark(Stage::query);
    is_read_ = false;
  }

  Counts counts() override {
    Counts counts;
    counts.pairs = is_complete() ? pairs().size() : count_;
    counts.candidates = counts.pairs;
    return counts;
  }
  std::vector<Pair> download() override {
    const std::span<const Pair> found = pairs();
    return {found.begin(), found.end()};
  }
  std::span<const Pair> sorted_pairs() override { return pairs(); }

  /// Reads the plug-in's pairs once for each find_pairs().
  std::span<const Pair> pairs() override {
    if (is_read_) return pairs_;
    pairs_.clear();
    for (const octocell_pair p : room_.first(std::min(count_, room_.capacity()))) {
      const std::size_t n = scene_.spheres.size();
      if (p.i >= n || p.j >= n || p.i == p.j) {
        throw InputError(
            fmt::format("the plug-in gives the pair {}, {} of {} spheres", p.i, p.j, n));
      }
      const bool counts = scene_.flags.empty() || may_collide(scene_.flags[p.i], scene_.flags[p.j]);
      if (counts) pairs_.push_back(make_pair_of(p.i, p.j));
    }
    std::ranges::sort(pairs_);
    is_read_ = true;
    return pairs_;
  }

  PairDigest digest() override { return digest_of(pairs()); }

  [[nodiscard]] HostBytes host_bytes(const Plan&, SceneView) const override {
    return {.per_pair = 2 * sizeof(Pair)};
  }

 private:
  [[nodiscard]] bool is_complete() const { return count_ <= room_.capacity(); }

  void let_go() {
    if (std::exchange(is_prepared_, false)) library_->finish();
  }

  std::shared_ptr<const PluginLibrary> library_;
  SceneView scene_;
  PairRoom room_;
  std::vector<Pair> pairs_;
  std::uint64_t count_ = 0;
  bool stores_pairs_ = true;
  bool is_prepared_ = false;
  bool is_read_ = false;  // pairs_ holds what the last find_pairs() found
};

}  // namespace

std::unique_ptr<PairFinder> make_plugin_finder(std::shared_ptr<const PluginLibrary> library) {
  return std::make_unique<PluginFinder>(std::move(library));
}

}  // namespace octocell
