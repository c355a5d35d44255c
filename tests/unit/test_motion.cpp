// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/flags.hpp"
#include "harness/files/frames.hpp"
#include "harness/files/save.hpp"
#include "harness/scenes/motion.hpp"
#include "harness/scenes/scenes.hpp"
#include "tests/support/scene_folder.hpp"

namespace octocell {
namespace {

constexpr std::uint64_t kSeed = 1;

/// FNV-1a over the bits of all frames.
std::uint64_t fingerprint(const Frames& frames) {
  std::uint64_t hash = 14695981039346656037U;
  for (const std::vector<Sphere>& spheres : frames) {
    for (const Sphere& s : spheres) {
      for (const float v : {s.x, s.y, s.z, s.r}) {
        hash = (hash ^ std::bit_cast<std::uint32_t>(v)) * 1099511628211U;
      }
    }
  }
  return hash;
}

class Motions : public testing::TestWithParam<Motion> {};

TEST_P(Motions, StartWithTheSceneAndKeepRadiiAndNumbers) {
  const std::vector<Sphere> start = generate("poly:n=500").spheres;
  const Frames frames = move(start, GetParam(), 12, kSeed);
  ASSERT_EQ(frames.size(), 12U);
  for (std::size_t i = 0; i < start.size(); ++i) {
    EXPECT_EQ(frames[0][i].x, start[i].x);
    for (const auto& frame : frames) EXPECT_EQ(frame[i].r, start[i].r);
  }
  EXPECT_EQ(fingerprint({frames[0]}) == fingerprint({frames[11]}), GetParam() == Motion::still);
}

TEST_P(Motions, TakeSmallSteps) {
  if (GetParam() == Motion::darts) return;  // see below
  const Frames frames = move(generate("gas:n=500").spheres, GetParam(), 4, kSeed);
  for (std::size_t f = 1; f < frames.size(); ++f) {
    for (std::size_t i = 0; i < 500; ++i) {
      const Sphere& a = frames[f - 1][i];
      const Sphere& b = frames[f][i];
      ASSERT_LE(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0.1F * a.r * 1.01F) << f;
    }
  }
}

TEST_P(Motions, AreTheSameEveryTime) {
  const std::vector<Sphere> start = generate("gas:n=300").spheres;
  EXPECT_EQ(fingerprint(move(start, GetParam(), 9, kSeed)),
            fingerprint(move(start, GetParam(), 9, kSeed)));
}

TEST_P(Motions, DoNotMindScenesWithoutExtent) {
  for (const char* spec : {"gas:n=0", "gas:n=1", "identical:n=5"}) {
    const Frames frames = move(generate(spec).spheres, GetParam(), 5, kSeed);
    for (const auto& frame : frames) {
      for (const Sphere& s : frame) EXPECT_TRUE(std::isfinite(s.x + s.y + s.z)) << spec;
    }
  }
}

TEST_P(Motions, LeaveStaticSpheresWhereTheyAre) {
  const Scene scene = generate("gas:n=400,static=0.5");
  const Frames without = move(scene.spheres, GetParam(), 8, kSeed);
  const Frames frames = move(scene.spheres, GetParam(), 8, kSeed, scene.flags);
  Frames expected = without;
  for (auto& frame : expected) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (is_static(scene.flags[i])) frame[i] = scene.spheres[i];
    }
  }
  EXPECT_EQ(fingerprint(frames), fingerprint(expected));
  if (GetParam() == Motion::still) return;
  EXPECT_NE(fingerprint(frames), fingerprint(without));
  EXPECT_NE(fingerprint({frames[7]}), fingerprint({frames[0]}));
}

INSTANTIATE_TEST_SUITE_P(All, Motions,
                         testing::Values(Motion::brownian, Motion::free_fall, Motion::gravity,
                                         Motion::slow, Motion::few, Motion::darts, Motion::still),
                         [](const auto& motion) {
                           return std::string(kMotionNames[static_cast<std::size_t>(motion.param)]);
                         });

TEST(Motion, WallsHoldBrownianSpheres) {
  const std::vector<Sphere> start = generate("gas:n=300").spheres;
  const Frames frames = move(start, Motion::brownian, 50, kSeed);
  float lowest = 0.0F;
  for (const Sphere& s : start) lowest = std::min(lowest, s.x);
  for (const auto& frame : frames) {
    for (const Sphere& s : frame) ASSERT_GE(s.x, lowest);
  }
}

TEST(Motion, SlowSpheresTakeATenthOfTheStep) {
  const Frames frames = move(generate("gas:n=500").spheres, Motion::slow, 4, kSeed);
  for (std::size_t f = 1; f < frames.size(); ++f) {
    for (std::size_t i = 0; i < 500; ++i) {
      const Sphere& a = frames[f - 1][i];
      const Sphere& b = frames[f][i];
      ASSERT_LE(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0.01F * a.r * 1.01F) << f;
    }
  }
}

/// Expects that about so many of 5000 spheres move, the same in every frame.
void expect_movers(Motion motion, double expected) {
  const Frames frames = move(generate("gas:n=5000").spheres, motion, 5, kSeed);
  const auto moved = [](const Sphere& a, const Sphere& b) {
    return a.x != b.x || a.y != b.y || a.z != b.z;
  };
  std::size_t movers = 0;
  for (std::size_t i = 0; i < 5000; ++i) {
    const bool moves = moved(frames[0][i], frames[1][i]);
    movers += moves ? 1 : 0;
    for (std::size_t f = 2; f < frames.size(); ++f) {
      ASSERT_EQ(moved(frames[f - 1][i], frames[f][i]), moves) << i;
    }
  }
  EXPECT_NEAR(static_cast<double>(movers), expected, expected / 4.0);
}

TEST(Motion, AFewAreATenthAndStayTheSame) { expect_movers(Motion::few, 500.0); }

TEST(Motion, DartsAreAHundredthAndFly) {
  expect_movers(Motion::darts, 50.0);
  const Frames frames = move(generate("gas:n=5000").spheres, Motion::darts, 2, kSeed);
  float longest = 0.0F;
  for (std::size_t i = 0; i < 5000; ++i) {
    longest = std::max(longest, std::fabs(frames[1][i].x - frames[0][i].x) / frames[0][i].r);
  }
  EXPECT_GT(longest, 1.0F);
  EXPECT_LE(longest, 2.001F);
}

TEST(Motion, FreeFallGoesDownAndGravityInwards) {
  const std::vector<Sphere> start = generate("gas:n=300").spheres;
  const auto mean = [](const std::vector<Sphere>& spheres, auto of) {
    double sum = 0.0;
    for (const Sphere& s : spheres) sum += of(s);
    return sum / static_cast<double>(spheres.size());
  };
  const auto height = [](const Sphere& s) { return s.z; };
  const auto distance = [](const Sphere& s) { return std::hypot(s.x, s.y, s.z); };
  EXPECT_LT(mean(move(start, Motion::free_fall, 20, kSeed).back(), height), mean(start, height));
  EXPECT_LT(mean(move(start, Motion::gravity, 20, kSeed).back(), distance), mean(start, distance));
}

TEST(Motion, UnknownNamesAreRefusedWithTheKnownOnes) {
  try {
    motion_named("swirl");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("brownian"), std::string::npos);
  }
}

class Trajectories : public SceneFiles {};

TEST_F(Trajectories, AreReadInTheOrderOfTheirNames) {
  save_scene(path("frame_2.npy"), generate("gas:n=10,seed=2").spheres);
  save_scene(path("frame_1.npy"), generate("gas:n=10,seed=1").spheres);
  const Frames frames = load_frames(folder_.string());
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0][3].x, generate("gas:n=10,seed=1").spheres[3].x);
}

TEST_F(Trajectories, AreReadInTheirNaturalOrder) {
  const char* const kNames[] = {"f0.npy", "f2.npy", "f10.npy", "f100.npy", "g01.npy", "g10.npy"};
  for (int k = 5; k >= 0; --k) {
    save_scene(path(kNames[k]), generate("gas:n=10,seed=" + std::to_string(k)).spheres);
  }
  const Frames frames = load_frames(folder_.string());
  ASSERT_EQ(frames.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) {
    const Scene expected = generate("gas:n=10,seed=" + std::to_string(k));
    EXPECT_EQ(frames[k][3].x, expected.spheres[3].x) << kNames[k];
  }
}

TEST_F(Trajectories, AreNotWhatIsHidden) {
  write(".hidden.npy", "not an array");
  write("._f1.npy", "what another system leaves beside a file");
  save_scene(path("f1.npy"), generate("gas:n=10").spheres);
  EXPECT_EQ(load_frames(folder_.string()).size(), 1U);
}

TEST_F(Trajectories, AreRefusedIfEmptyMissingOrOfDifferentLengths) {
  EXPECT_THROW(load_frames(folder_.string()), InputError);
  EXPECT_THROW(load_frames(path("nowhere")), InputError);
  save_scene(path("a.npy"), generate("gas:n=10").spheres);
  save_scene(path("b.npy"), generate("gas:n=11").spheres);
  EXPECT_THROW(load_trajectory(folder_.string()), InputError);
}

TEST_F(Trajectories, MayHoldOtherNumbersOfSpheresAsFrames) {
  const int kCounts[] = {2, 0, 3};
  const char* const kNames[] = {"f2.npy", "f9.npy", "f10.npy"};
  for (int k = 0; k < 3; ++k) {
    save_scene(path(kNames[k]), generate("gas:n=" + std::to_string(kCounts[k])).spheres);
  }
  const Frames frames = load_frames(folder_.string());
  ASSERT_EQ(frames.size(), 3U);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(frames[k].size(), kCounts[k]);
  try {
    load_trajectory(folder_.string());
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("f9.npy: 0 spheres"), std::string::npos);
  }
}

}  // namespace
}  // namespace octocell
