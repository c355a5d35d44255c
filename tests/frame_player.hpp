// SPDX-License-Identifier: MIT
// Plays frames to a finder as the bench does, and says what may be forbidden meanwhile.
#pragma once

#include <gtest/gtest.h>

#include "harness/driver/complete.hpp"
#include "harness/reference/reference.hpp"
#include "tests/frame_sequences.hpp"

namespace octocell {

inline PlanOptions moving(Skips allowed = Skips::all(), int threads = 1) {
  return {.method = Method::half_shell, .threads = threads, .allowed = allowed, .moving = true};
}

/// Plays frames as the bench does: announces each, and plans again where a plan no longer holds.
class Player {
 public:
  Player(const PlanOptions& options, std::unique_ptr<PairFinder> finder)
      : options_(options), finder_(std::move(finder)) {}

  Counts show(SceneView scene) {
    HostClock clock;
    if (plan_ && plan_->facts.sphere_count == scene.spheres.size()) {
      finder_->update(scene);
      finder_->find_pairs(clock);
      times_ = clock.stop();
      const Counts counts = finder_->counts();
      if (!counts.plan_violation && fits(counts, plan_->capacity, plan_->count_only)) return counts;
    }
    ++plans_;
    const Outcome outcome = complete(*finder_, scene, plan_scene(scene, options_), clock);
    plan_ = outcome.plan;
    times_ = outcome.times;
    return outcome.counts;
  }

  /// Shows a frame and expects its exact pairs.
  Counts check(SceneView scene, const std::string& what) {
    const Counts counts = show(scene);
    const std::vector<Pair> truth = reference::exact_pairs(scene.spheres, scene.flags);
    const reference::Comparison found = reference::compare(finder_->download(), truth);
    EXPECT_TRUE(found.exact()) << what << ": missed " << found.missed << ", false "
                               << found.false_pairs << ", twice " << found.duplicates;
    EXPECT_EQ(finder_->digest(), digest_of(truth)) << what;
    EXPECT_EQ(counts.pairs, truth.size()) << what;
    return counts;
  }

  [[nodiscard]] const StageTimes& times() const { return times_; }
  [[nodiscard]] const Plan& plan() const { return *plan_; }
  [[nodiscard]] int plans() const { return plans_; }
  PairFinder& finder() { return *finder_; }

 private:
  PlanOptions options_;
  std::unique_ptr<PairFinder> finder_;
  std::optional<Plan> plan_;
  StageTimes times_;
  int plans_ = 0;
};

/// All allowed, each alone forbidden, each alone allowed, none.
inline std::vector<Skips> choices() {
  constexpr Skip kSkipsOfFrames[] = {Skip::unchanged, Skip::few_movers, Skip::skin};
  Skips none = Skips::all();
  for (const Skip skip : kSkipsOfFrames) none = none.without(skip);
  std::vector<Skips> choices = {Skips::all(), none};
  for (const Skip skip : kSkipsOfFrames) {
    choices.push_back(Skips::all().without(skip));
    choices.push_back(none.with(skip));
  }
  return choices;
}

}  // namespace octocell
