// SPDX-License-Identifier: MIT
// What all baselines share: when a structure is built, when it is brought up to date, and what of
// that is timed. A baseline adds how its library does each.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "baselines/candidate_sink.hpp"

namespace octocell::baselines {

class BaselineFinder : public PairFinder {
 public:
  void upload(const Plan& plan, SceneView scene) final {
    start_anew(scene);
    sink_.prepare(plan);
  }

  void update(SceneView scene) final {
    const bool same_count = scene.spheres.size() == scene_.spheres.size();
    if (!standing_ || cut_short() || !same_count || !can_follow(scene)) {
      start_anew(scene);
      return;
    }
    scene_ = scene;
    moved_ = true;
    pairs_ahead_ = pairs_ahead();
  }

  void find_pairs(StageClock& clock) final {
    sink_.begin(scene_);
    if (auto reason = why_impossible()) {
      sink_.refuse(std::move(*reason));
      return leave_undone(clock);
    }
    if (!sink_.allows(pairs_ahead_)) return leave_undone(clock);
    const bool follows = standing_ && moved_;
    if (standing_ && !follows) tear_down();
    clock.start();
    if (follows) {
      follow();
      clock.mark(Stage::update);
    } else {
      build();
      clock.mark(Stage::build);
    }
    if (!refused()) query();
    clock.mark(Stage::query);
    standing_ = true;
    moved_ = false;
  }

  Counts counts() final { return sink_.counts(); }
  std::vector<Pair> download() final {
    const std::span<const Pair> pairs = sink_.sort_pairs();
    return {pairs.begin(), pairs.end()};
  }
  std::span<const Pair> sorted_pairs() final { return sink_.sort_pairs(); }
  [[nodiscard]] HostBytes host_bytes(const Plan&, SceneView scene) const final {
    // 200 (btDbvt) to 580 (DynamicAABBTree_Array), as measured: peak_bytes in reports/results.
    constexpr double kOfSphere = 580.0;
    return {.fixed = kOfSphere * static_cast<double>(scene.spheres.size()),
            .per_pair = sizeof(Pair)};
  }
  PairDigest digest() final { return sink_.digest(); }

 protected:
  /// Untimed: makes the library's own objects for the scene, if it wants any.
  virtual void make_objects() {}
  /// Untimed: can the standing structure be brought to this scene, of as many spheres as before?
  virtual bool can_follow(SceneView) { return true; }
  /// Untimed: why the library cannot hold this scene, in one line; nothing if it can.
  virtual std::optional<std::string> why_impossible() { return std::nullopt; }
  /// Untimed: how many pairs the library will compare on this scene, where that is known beforehand
  /// and can be far more than the candidates it reports; 0 where it is not.
  virtual std::uint64_t pairs_ahead() { return 0; }
  /// Untimed: back to nothing, so that the next build() starts from there.
  virtual void tear_down() = 0;
  /// Timed: from nothing to a structure that can be asked; or refuses by sink().refuse().
  virtual void build() = 0;
  /// Timed: the spheres have moved; the library's own way to follow them.
  virtual void follow() = 0;
  /// Timed: every candidate pair to the sink, once.
  virtual void query() = 0;

  [[nodiscard]] std::span<const Sphere> spheres() const { return scene_.spheres; }
  [[nodiscard]] CandidateSink& sink() { return sink_; }

 private:
  [[nodiscard]] bool refused() const { return sink_.counts().plan_violation.has_value(); }
  /// The structure may be incomplete, so it cannot be brought up to date.
  [[nodiscard]] bool cut_short() const { return refused() || sink_.counts().over_candidate_limit; }

  void start_anew(SceneView scene) {
    if (standing_) tear_down();
    scene_ = scene;
    standing_ = moved_ = false;
    make_objects();
    pairs_ahead_ = pairs_ahead();
  }

  void leave_undone(StageClock& clock) {
    if (standing_) tear_down();
    standing_ = moved_ = false;
    clock.start();
  }

  SceneView scene_;
  CandidateSink sink_;
  std::uint64_t pairs_ahead_ = 0;
  bool standing_ = false;  // a structure of an earlier find_pairs() is there
  bool moved_ = false;     // and the spheres are no longer where it has them
};

}  // namespace octocell::baselines
