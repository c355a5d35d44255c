// SPDX-License-Identifier: MIT
// The rules by which impl_cuda_custom reuses data of the last frame, without a GPU: a model that
// reads spheres one by one, like the kernels, and lists neighbor pairs with the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/plan.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cuda_custom/coherence/rules.hpp"
#include "tests/support/frame_sequences.hpp"

namespace octocell::cuda_custom::coherence {
namespace {

/// What the device holds, and what a frame does with it.
class Model {
 public:
  Model(const Allowed& allowed, float growth, double static_share)
      : allowed_(allowed), growth_(growth), static_share_(static_share) {}

  FrameMode play(const Spheres& now) {
    if (now.size() != before_.size()) start_again(now);
    const FrameTasks tasks = tasks_of(history_, true, allowed_);
    FrameHistory seen = history_;
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < now.size(); ++i) found |= look_at(tasks, now[i], i);
    seen.still_now = std::ranges::equal(now, before_, same_bits) ? kSampled : 0;
    const FrameMode mode = mode_of(tasks, found);
    history_ = after(seen, tasks, mode, allowed_, growth_);
    answer(now, mode);
    before_ = now;
    return mode;
  }
  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }
  [[nodiscard]] std::vector<Pair> truth(const Spheres& spheres) const {
    return reference::exact_pairs(spheres, flags_);
  }

 private:
  void start_again(const Spheres& now) {
    history_ = {};
    snapshot_ = searched_ = before_ = Spheres(now.size());
    flags_ = flags_of(now.size(), static_share_, 11);
  }

  std::uint32_t look_at(const FrameTasks& tasks, const Sphere& now, std::size_t i) {
    if (tasks.take_snapshot) snapshot_[i] = now;
    if (tasks.compare && same_bits(now, snapshot_[i])) return 0;
    if (!tasks.check_skin) return kDiffers;
    const float growth = growth_of(flags(), static_cast<std::uint32_t>(i), history_.growth);
    const Verdict verdict = within_skin(searched_[i], now, growth);
    if (growth == 0.0F) {
      EXPECT_EQ(verdict == Verdict::overlap, same_bits(searched_[i], now));
      return verdict == Verdict::overlap ? kDiffers : kDiffers | kLeft;
    }
    const SkinTest test = skin_test_of(searched_[i], now, growth);
    const bool truth =
        reference::overlap(test.ball, test.point) && bits_of(searched_[i].r) == bits_of(now.r);
    if (verdict != Verdict::uncertain) {
      EXPECT_EQ(verdict == Verdict::overlap, truth);
    }
    return truth ? kDiffers : kDiffers | kLeft;
  }

  void answer(const Spheres& now, FrameMode mode) {
    if (mode == FrameMode::search) {
      pairs_ = truth(now);
      searched_ = now;
      if (history_.list_made != 0) build_neighbor_list(now);
    }
    if (mode != FrameMode::neighbor_list) return;
    pairs_.clear();
    for (const Pair& pair : near_) {
      if (reference::overlap(now[pair.i], now[pair.j])) pairs_.push_back(pair);
    }
  }

  void build_neighbor_list(Spheres grown) {
    for (std::uint32_t i = 0; i < grown.size(); ++i) {
      grown[i].r = radius_in_search(grown[i], flags(), i, growth_);
    }
    near_ = truth(grown);
    history_.neighbor_list = near_.size();
  }

  [[nodiscard]] const Flags* flags() const { return flags_.empty() ? nullptr : flags_.data(); }

  Allowed allowed_;
  float growth_;
  double static_share_;
  AllFlags flags_;
  FrameHistory history_ = {};
  Spheres before_;
  Spheres snapshot_;
  Spheres searched_;
  std::vector<Pair> near_;
  std::vector<Pair> pairs_;
};

class SharesOfStatic : public testing::TestWithParam<double> {};

TEST_P(SharesOfStatic, TakeOverOnlyWhatIsProved) {
  constexpr std::uint64_t kRoom = 1'000'000;
  const Allowed choices[] = {
      {true, true, kRoom}, {true, false, 0}, {false, true, kRoom}, {true, true, 2000}};
  int served[4] = {};
  for (const Sequence& sequence : sequences()) {
    for (const Allowed& allowed : choices) {
      Model model(allowed, 0.05F, GetParam());
      for (std::size_t f = 0; f < sequence.frames.size(); ++f) {
        const FrameMode mode = model.play(sequence.frames[f]);
        ++served[static_cast<std::size_t>(mode)];
        ASSERT_EQ(model.pairs(), model.truth(sequence.frames[f]))
            << sequence.name << ", frame " << f;
        ASSERT_TRUE(mode != FrameMode::unchanged || allowed.unchanged);
        ASSERT_TRUE(mode != FrameMode::neighbor_list || allowed.neighbor_list);
      }
    }
  }
  EXPECT_GT(served[static_cast<std::size_t>(FrameMode::unchanged)], 20);
  EXPECT_GT(served[static_cast<std::size_t>(FrameMode::neighbor_list)],
            GetParam() > 0.0 ? 50 : 100);
}

INSTANTIATE_TEST_SUITE_P(CoherenceRules, SharesOfStatic, testing::Values(-1.0, 0.0, 0.9));

constexpr Allowed kAll = {true, true, 100};
FrameHistory all_known() {
  FrameHistory history = {};
  history.frames = 7;
  history.snapshot_holds = history.list_made = 1;
  history.growth = 0.5F;
  history.neighbor_list = 100;
  return history;
}

TEST(CoherenceRules, AFrameThatFailedIsNoGround) {
  const FrameTasks tasks = tasks_of(all_known(), false, kAll);
  EXPECT_FALSE(tasks.compare || tasks.check_skin);
  EXPECT_EQ(mode_of(tasks, 0), FrameMode::search);
}

TEST(CoherenceRules, AListThatIsTooShortIsNoGround) {
  FrameHistory history = all_known();
  EXPECT_TRUE(tasks_of(history, true, kAll).check_skin);
  ++history.neighbor_list;
  EXPECT_FALSE(tasks_of(history, true, kAll).check_skin);
}

TEST(CoherenceRules, NothingIsTriedThatIsForbiddenOrUnknown) {
  const FrameTasks forbidden = tasks_of(all_known(), true, {});
  EXPECT_FALSE(forbidden.compare || forbidden.check_skin || forbidden.take_snapshot);
  const FrameTasks unknown = tasks_of({}, true, kAll);
  EXPECT_FALSE(unknown.compare || unknown.check_skin);
  EXPECT_TRUE(unknown.take_snapshot);
}

TEST(CoherenceRules, ASnapshotIsTakenOnceNothingMoves) {
  FrameHistory history = all_known();
  history.snapshot_holds = 0;
  EXPECT_FALSE(tasks_of(history, true, kAll).take_snapshot);
  history.still = kSampled;
  EXPECT_TRUE(tasks_of(history, true, kAll).take_snapshot);
}

TEST(CoherenceRules, WhatIsSeenDecidesTheMode) {
  const FrameTasks tasks = tasks_of(all_known(), true, kAll);
  EXPECT_EQ(mode_of(tasks, 0), FrameMode::unchanged);
  EXPECT_EQ(mode_of(tasks, kDiffers), FrameMode::neighbor_list);
  EXPECT_EQ(mode_of(tasks, kDiffers | kLeft), FrameMode::search);
}

TEST(CoherenceRules, AZeroOfAnotherSignIsAnotherSphere) {
  EXPECT_FALSE(same_bits({0.0F, 0, 0, 1}, {-0.0F, 0, 0, 1}));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(same_bits({nan, 0, 0, 1}, {nan, 0, 0, 1}));
}

TEST(CoherenceRules, AnotherRadiusLeavesAnySkin) {
  EXPECT_EQ(within_skin({0, 0, 0, 1}, {0, 0, 0, 1}, 0.1F), Verdict::overlap);
  EXPECT_EQ(within_skin({0, 0, 0, 1}, {0, 0, 0, std::nextafter(1.0F, 0.0F)}, 0.1F), Verdict::apart);
  EXPECT_EQ(within_skin({0, 0, 0, 1}, {0.2F, 0, 0, 1}, 0.1F), Verdict::apart);
  EXPECT_EQ(within_skin({0, 0, 0, 1}, {0.1F, 0, 0, 1}, 0.1F), Verdict::uncertain);
}

TEST(CoherenceRules, StaticSpheresDoNotGrowAndMustStand) {
  const Flags flags[] = {make_flags(true, 1, kMaxMask), make_flags(false, 1, kMaxMask)};
  const Sphere s = {0, 0, 0, 1};
  EXPECT_EQ(radius_in_search(s, flags, 0, 0.5F), 1.0F);
  EXPECT_GE(radius_in_search(s, flags, 1, 0.5F), 1.5F);
  EXPECT_GE(radius_in_search(s, nullptr, 0, 0.5F), 1.5F);
  EXPECT_EQ(radius_in_search(s, flags, 1, 0.0F), 1.0F);
  EXPECT_EQ(within_skin(s, s, growth_of(flags, 0, 0.5F)), Verdict::overlap);
  EXPECT_EQ(within_skin(s, {0x1p-149F, 0, 0, 1}, growth_of(flags, 0, 0.5F)), Verdict::apart);
  EXPECT_EQ(within_skin(s, {0x1p-149F, 0, 0, 1}, growth_of(flags, 1, 0.5F)), Verdict::overlap);
}

}  // namespace
}  // namespace octocell::cuda_custom::coherence
