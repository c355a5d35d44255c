// SPDX-License-Identifier: MIT
// Shows random sequences of frames to a finder, with random plans, buffers and forbidden skips.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/support/frame_player.hpp"
#include "tests/support/random_frames.hpp"

namespace octocell {

inline constexpr const char* kFrameSeed = "OCTOCELL_FRAME_SEED";
inline constexpr const char* kFrameSequences = "OCTOCELL_FRAME_SEQUENCES";

inline std::uint64_t number_from_environment(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

/// One seed: one finder, which sees up to three sequences one after another.
class RandomPlayer {
 public:
  RandomPlayer(std::uint64_t seed, std::unique_ptr<PairFinder> finder, std::size_t most_spheres)
      : dice_(seed), most_spheres_(most_spheres), player_({}, std::move(finder)) {}

  void play(Served& served) {
    for (std::size_t k = 1 + dice_.below(3); k > 0 && !testing::Test::HasFailure(); --k) {
      play_sequence(served);
    }
  }

 private:
  /// Returns a size that is usually small.
  std::size_t random_size() {
    const std::size_t most[] = {3, 20, 60, 60, 60, 200, 200, dice_.one_in(4) ? most_spheres_ : 200};
    return dice_.below(1 + most[dice_.below(std::size(most))]);
  }

  /// Returns all skips but some, or only some.
  Skips random_skips() {
    const std::size_t one_in = dice_.one_in(3) ? 2 : 12;
    Skips allowed = Skips::all();
    for (std::size_t k = 0; k < kSkipCount; ++k) {
      const auto skip = static_cast<Skip>(k);
      if (skip != Skip::phantoms && dice_.one_in(one_in)) allowed = allowed.without(skip);
    }
    return allowed;
  }

  PlanOptions random_options() {
    PlanOptions options = moving(random_skips(), static_cast<int>(1 + dice_.below(3)));
    options.count_only = dice_.one_in(8);
    return options;
  }

  void play_sequence(Served& served) {
    RandomFrames frames(random_size(), dice_.seed());
    const PlanOptions options = random_options();
    player_.plan_again(options);
    const std::size_t count = 5 + dice_.below(25);
    for (std::size_t f = 0; f < count && !testing::Test::HasFailure(); ++f) {
      if (f > 0) frames.next();
      const bool has_old_plan = dice_.one_in(frames.is_another_scene() ? 2 : 30);
      if (f > 0 && has_old_plan) player_.upload_next(player_.plan());
      SCOPED_TRACE("frame " + std::to_string(f) + " of " +
                   std::to_string(frames.scene().spheres.size()) + " spheres, " +
                   std::to_string(options.threads) + " threads: " + frames.event());
      if (frames.is_valid()) {
        check(frames, options, served);
        if (dice_.one_in(20)) leave_no_room();
      } else {
        EXPECT_THROW(player_.show(frames.scene()), InputError);
      }
    }
  }

  void check(RandomFrames& frames, const PlanOptions& options, Served& served) {
    const SceneView scene = frames.scene();
    const Counts counts = player_.show(scene);
    const std::vector<Pair> truth = reference::exact_pairs(scene.spheres, scene.flags);
    EXPECT_EQ(counts.pairs, truth.size());
    EXPECT_EQ(player_.finder().digest(), digest_of(truth));
    if (!options.count_only) {
      EXPECT_EQ(player_.finder().download(), truth);
    }
    const Skips left_out = counts.used.either(player_.plan().taken);
    EXPECT_EQ(left_out.either(options.allowed), options.allowed) << "more than is allowed";
    if (!counts.reused) return frames.was_searched(player_.plan());
    EXPECT_TRUE(options.allowed.has(*counts.reused));
    ++served[static_cast<std::size_t>(*counts.reused)];
  }

  /// Makes buffers that hold just what was found: with one pair more, they are too small.
  void leave_no_room() {
    Plan plan = player_.plan();
    const std::uint64_t pairs = player_.finder().counts().pairs;
    if (!plan.count_only) plan.capacity.pairs = plan.capacity.uncertain_pairs = pairs;
    player_.upload_next(plan);
  }

  Dice dice_;
  const std::size_t most_spheres_;
  Player player_;
};

/// Plays `count` seeds, or as many as the environment says, starting with its seed. Stops at the
/// first that fails, and says how to repeat it. If there are many seeds, each of `skips` must have
/// been used.
template <typename NewFinder>
void play_random_frames(std::uint64_t count, std::size_t most_spheres, const NewFinder& new_finder,
                        std::initializer_list<Skip> skips) {
  constexpr std::uint64_t kMany = 100;
  const std::uint64_t first = number_from_environment(kFrameSeed, 1);
  const std::uint64_t last = first + number_from_environment(kFrameSequences, count);
  Served served = {};
  for (std::uint64_t seed = first; seed < last && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(std::string("to repeat: ") + kFrameSeed + "=" + std::to_string(seed) + " " +
                 kFrameSequences + "=1");
    try {
      RandomPlayer(seed, new_finder(), most_spheres).play(served);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  if (last - first >= kMany) expect_all_to_have_served(skips, served);
}

}  // namespace octocell
