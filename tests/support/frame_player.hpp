// SPDX-License-Identifier: MIT
// Plays frames to a finder like the bench, with the skips that may be forbidden.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/engine/find_completely.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/support/frame_sequences.hpp"

namespace octocell {

inline PlanOptions moving(Skips allowed = Skips::all(), int threads = 1) {
  return {.method = Method::half_shell, .threads = threads, .allowed = allowed, .moving = true};
}

/// Plays frames like the bench: announces each, and plans again if a plan no longer holds.
class Player {
 public:
  Player(const PlanOptions& options, std::unique_ptr<PairFinder> finder)
      : options_(options), finder_(std::move(finder)) {}

  Counts show(SceneView scene) {
    HostClock clock;
    if (plan_ && plan_->facts.sphere_count == scene.spheres.size()) {
      if (std::exchange(uploads_next_, false)) {
        finder_->upload(*plan_, scene);
      } else {
        finder_->update(scene);
      }
      finder_->find_pairs(clock);
      times_ = clock.stop();
      const Counts counts = finder_->counts();
      if (!counts.plan_violation && fits(counts, plan_->capacity, plan_->count_only)) return counts;
    }
    ++plans_;
    uploads_next_ = false;
    const Outcome outcome = complete(*finder_, scene, plan_scene(scene, options_), clock);
    plan_ = outcome.plan;
    times_ = outcome.times;
    return outcome.counts;
  }

  /// The next frame begins another sequence for the same finder.
  void plan_again(const PlanOptions& options) {
    options_ = options;
    plan_.reset();
  }
  /// The next frame is uploaded with that plan, if it has the same number of spheres.
  void upload_next(const Plan& plan) {
    plan_ = plan;
    uploads_next_ = true;
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
  bool uploads_next_ = false;
  StageTimes times_;
  int plans_ = 0;
};

/// Returns all skips allowed, each one forbidden, each one allowed alone, none allowed.
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

/// For each skip: how many frames used it.
using Served = std::array<int, kSkipCount>;

/// Plays every sequence with every choice: each frame has the exact pairs and uses no forbidden
/// skip. flags_for(spheres) returns the flags of a frame.
template <typename NewPlayer, typename FlagsFor>
void play_with_every_choice(const NewPlayer& new_player, const FlagsFor& flags_for,
                            Served& served) {
  const std::vector<Skips> choices = octocell::choices();
  for (const Sequence& sequence : sequences()) {
    std::vector<Player> players;
    for (const Skips allowed : choices) players.push_back(new_player(allowed));
    for (std::size_t f = 0; f < sequence.frames.size(); ++f) {
      const Spheres& spheres = sequence.frames[f];
      const std::vector<Flags> flags = flags_for(spheres);
      const std::vector<Pair> truth = reference::exact_pairs(spheres, flags);
      for (std::size_t c = 0; c < players.size(); ++c) {
        const Counts counts = players[c].show({spheres, flags});
        const std::string what =
            sequence.name + ", frame " + std::to_string(f) + ", choice " + std::to_string(c);
        ASSERT_EQ(players[c].finder().digest(), digest_of(truth)) << what;
        ASSERT_EQ(players[c].finder().download(), truth) << what;
        ASSERT_EQ(counts.pairs, truth.size()) << what;
        if (!counts.reused) continue;
        ASSERT_TRUE(choices[c].has(*counts.reused)) << what;
        ASSERT_TRUE(counts.used.has(*counts.reused)) << what;
        ++served[static_cast<std::size_t>(*counts.reused)];
      }
    }
  }
}

inline void expect_all_to_have_served(std::initializer_list<Skip> skips, const Served& served,
                                      int more_than = 50) {
  for (const Skip skip : skips) {
    EXPECT_GT(served[static_cast<std::size_t>(skip)], more_than)
        << name_of(skip) << " is not tested";
  }
}

}  // namespace octocell
