// SPDX-License-Identifier: MIT
// If a frame breaks the plan's facts, that frame reports it, even if it skips stage 1.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "harness/scenes/scenes.hpp"
#include "impl_cpu/backend.hpp"
#include "tests/support/frame_player.hpp"

namespace octocell {
namespace {

void expect_violations_as_if_searched(const Frames& frames, const AllFlags& flags,
                                      Skips allowed = Skips::all(), double lattice = 0.0) {
  const Skips none =
      Skips::all().without(Skip::unchanged).without(Skip::few_movers).without(Skip::skin);
  const std::unique_ptr<PairFinder> finder = cpu::make_backend();
  const std::unique_ptr<PairFinder> plain = cpu::make_backend();
  const SceneView first = {frames[0], flags};
  for (const bool is_plain : {false, true}) {
    Plan plan = plan_scene(first, moving(is_plain ? none : allowed));
    plan.facts.lattice_units_per_length = lattice;
    (is_plain ? plain : finder)->upload(plan, first);
  }
  HostClock clock;
  int violations = 0;
  int served = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (PairFinder* const each : {finder.get(), plain.get()}) {
      each->update({frames[f], flags});
      each->find_pairs(clock);
    }
    const Counts counts = finder->counts();
    EXPECT_EQ(counts.plan_violation, plain->counts().plan_violation) << f;
    if (!counts.plan_violation) {
      EXPECT_EQ(finder->digest(), plain->digest()) << f;
    }
    violations += counts.plan_violation ? 1 : 0;
    served += counts.reused == Skip::skin ? 1 : 0;
  }
  EXPECT_GT(violations, 0) << "nothing is tested";
  EXPECT_GT(served, 0) << "nothing is tested";
}

TEST(EveryFrame, SaysWhenSpheresDriftOutOfThePlansBox) {
  for (const double static_share : {-1.0, 0.5}) {
    for (float Sphere::*const axis : {&Sphere::x, &Sphere::y, &Sphere::z}) {
      for (const float step : {0.01F, -0.01F}) {
        Frames frames = {generate("gas:n=100").spheres};
        const AllFlags flags = flags_of(frames[0].size(), static_share, 13);
        while (frames.size() < 150) {
          Spheres next = frames.back();
          for (std::size_t i = 0; i < next.size(); ++i) {
            if (flags.empty() || !is_static(flags[i])) next[i].*axis += step;
          }
          frames.push_back(next);
        }
        expect_violations_as_if_searched(frames, flags);
      }
    }
  }
}

TEST(EveryFrame, SaysWhenSpheresAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const Spheres start = generate("gas:n=500").spheres;
  const AllFlags flags = flags_of(start.size(), 0.5, 13);
  for (const Sphere amiss : {Sphere{nan, 0, 0, start[0].r}, Sphere{0, infinity, 0, start[0].r},
                             Sphere{0, 0, nan, start[0].r}, Sphere{0, 0, 0, -start[0].r}}) {
    for (std::size_t i = 0; i < 8; ++i) {  // static ones and others
      Frames frames = move(start, Motion::slow, 8, 1, flags);
      frames.back()[i] = amiss;
      expect_violations_as_if_searched(frames, flags);
    }
  }
}

TEST(EveryFrame, SaysWhenSpheresLeaveTheLattice) {
  Frames frames(6, generate("lattice:n=1000").spheres);
  frames.back()[77].y = std::nextafter(frames.back()[77].y, 1e9F);
  const Skips skin_alone = Skips::all().without(Skip::unchanged).without(Skip::few_movers);
  expect_violations_as_if_searched(frames, {}, skin_alone, 2.0);
}

}  // namespace
}  // namespace octocell
