// SPDX-License-Identifier: MIT
// What all baselines share: when a structure is built or updated, and which part of that is timed.
// A baseline adds how its library does each.
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
    // Measured: 200 (btDbvt) to 580 (DynamicAABBTree_Array); peak_bytes in reports/results.
    constexpr double kOfSphere = 580.0;
    return {.fixed = kOfSphere * static_cast<double>(scene.spheres.size()),
            .per_pair = sizeof(Pair)};
  }
  PairDigest digest() final { return sink_.digest(); }

 protected:
  /// Makes the library's own objects for the scene, if it needs any. Untimed.
  virtual void make_objects() {}
  /// Returns true if the standing structure can be updated to this scene, which has as many
  /// spheres. Untimed.
  virtual bool can_follow(SceneView) { return true; }
  /// Returns in one line why the library cannot hold this scene; none if it can. Untimed.
  virtual std::optional<std::string> why_impossible() { return std::nullopt; }
  /// Returns how many pairs the library will compare on this scene, if that is known beforehand and
  /// can be far more than the candidates it reports; otherwise 0. Untimed.
  virtual std::uint64_t pairs_ahead() { return 0; }
  /// Removes the structure, so that the next build() starts from nothing. Untimed.
  virtual void tear_down() = 0;
  /// Builds a complete structure from nothing, or calls sink().refuse(). Timed.
  virtual void build() = 0;
  /// Updates the structure in the library's own way, after the spheres have moved. Timed.
  virtual void follow() = 0;
  /// Passes each candidate pair to the sink, once. Timed.
  virtual void query() = 0;

  [[nodiscard]] std::span<const Sphere> spheres() const { return scene_.spheres; }
  [[nodiscard]] CandidateSink& sink() { return sink_; }

 private:
  [[nodiscard]] bool refused() const { return sink_.counts().plan_violation.has_value(); }
  /// Returns true if the structure may be incomplete, so that it cannot be updated.
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
  bool standing_ = false;  // there is a structure of an earlier find_pairs()
  bool moved_ = false;     // the spheres have moved since that structure was built or updated
};

}  // namespace octocell::baselines
