// SPDX-License-Identifier: MIT
// Finders that have searched something before: frames of the same spheres, or other scenes.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "harness/engine/find_completely.hpp"
#include "harness/verify/stress/catalogue.hpp"

namespace octocell::stress {

/// Passes every call on to another finder.
class Wrapped : public PairFinder {
 public:
  explicit Wrapped(std::unique_ptr<PairFinder> inner) : inner_(std::move(inner)) {}
  void upload(const Plan& plan, SceneView scene) override { inner_->upload(plan, scene); }
  void update(SceneView scene) override { inner_->update(scene); }
  void find_pairs(StageClock& clock) override { inner_->find_pairs(clock); }
  std::unique_ptr<StageClock> make_clock(Marks marks) override { return inner_->make_clock(marks); }
  Counts counts() override { return inner_->counts(); }
  std::vector<Pair> download() override { return inner_->download(); }
  PairDigest digest() override { return inner_->digest(); }

 protected:
  std::unique_ptr<PairFinder> inner_;
};

/// Finds the pairs of each earlier frame, then those of the scene, as updates of one structure.
class AfterFrames final : public Wrapped {
 public:
  AfterFrames(std::unique_ptr<PairFinder> inner, std::span<const Spheres> frames)
      : Wrapped(std::move(inner)), frames_(frames) {}
  void upload(const Plan& plan, SceneView scene) override {
    scene_ = scene;
    inner_->upload(plan, {frames_.front()});
  }
  void find_pairs(StageClock& clock) override {
    inner_->find_pairs(clock);
    for (const Spheres& frame : frames_.subspan(1)) follow({frame}, clock);
    follow(scene_, clock);
  }

 private:
  void follow(SceneView frame, StageClock& clock) {
    inner_->update(frame);
    inner_->find_pairs(clock);
  }
  std::span<const Spheres> frames_;
  SceneView scene_;
};

/// Finds the pairs of other scenes, each with its own plan, before the scene is uploaded.
class AfterScenes final : public Wrapped {
 public:
  AfterScenes(std::unique_ptr<PairFinder> inner, std::span<const Spheres> others,
              const PlanOptions& options)
      : Wrapped(std::move(inner)), others_(others), options_(options) {}
  void upload(const Plan& plan, SceneView scene) override {
    for (const Spheres& other : std::exchange(others_, {}))
      find_completely(*inner_, {other}, options_);
    inner_->upload(plan, scene);
  }

 private:
  std::span<const Spheres> others_;
  PlanOptions options_;
};

}  // namespace octocell::stress
