// SPDX-License-Identifier: MIT
// What may happen between frames: sequences made to mislead code that reuses data of the last
// frame.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/flags.hpp"
#include "harness/scenes/motion.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {

using Spheres = std::vector<Sphere>;
using AllFlags = std::vector<Flags>;

/// Makes `share` of them static and puts the others in groups, some of which do not meet. No flags
/// if `share` is below zero.
inline AllFlags flags_of(std::size_t count, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  AllFlags flags(share < 0.0 ? 0 : count);
  for (Flags& f : flags) {
    f = make_flags(unit(random) < share, 1U << random() % 2, kMaxMask & ~(random() % 2));
  }
  return flags;
}

inline Frames played(const char* spec, Motion motion, int count = 10) {
  return move(generate(spec).spheres, motion, count, 1);
}

/// In every frame, `share` of the spheres take the places of others, radii included.
inline Frames teleports(const char* spec, double share) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Frames frames = {generate(spec).spheres};
  while (frames.size() < 10) {
    Spheres next = frames.back();
    for (Sphere& s : next) {
      if (unit(random) < share) std::swap(s, next[random() % next.size()]);
    }
    frames.push_back(next);
  }
  return frames;
}

/// Tangent spheres, of which a few move by the smallest possible step, back and forth.
inline Frames by_an_ulp(double share) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Spheres start = generate("lattice:n=1000").spheres;
  Frames frames = {start};
  while (frames.size() < 10) {
    Spheres next = start;
    for (Sphere& s : next) {
      if (unit(random) >= share) continue;
      float& value = random() % 2 == 0 ? s.x : s.z;
      value = std::nextafter(value, random() % 2 == 0 ? 1e9F : -1e9F);
    }
    frames.push_back(next);
  }
  return frames;
}

/// Radii change, within the range of the plan; places stay the same, or drift slowly.
inline Frames radii_change(double share, bool drift) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  Frames frames = played("poly:n=1200", drift ? Motion::slow : Motion::still);
  for (std::size_t f = 1; f < frames.size(); ++f) {
    for (std::size_t i = 0; i < frames[f].size(); ++i) {
      const Spheres& start = frames[0];
      if (unit(random) < static_cast<float>(share)) {
        frames[f][i].r = start[random() % start.size()].r;
      }
    }
  }
  return frames;
}

inline Frames a_b_a() {
  const Frames two = played("dense:n=1200", Motion::few, 2);
  const Frames far = played("dense:n=1200", Motion::brownian, 2);
  return {two[0], two[1], two[0], two[0], two[1], two[1], far[1], two[0], far[1], far[1], two[0]};
}

/// Slow motion, then none, then a few movers, then slow again, then everything is somewhere else.
inline Frames moods() {
  Frames frames = played("gas:n=1500", Motion::slow, 6);
  const auto go_on = [&frames](Motion motion, int count) {
    const Frames more = move(frames.back(), motion, count, frames.size());
    frames.insert(frames.end(), more.begin() + 1, more.end());
  };
  go_on(Motion::still, 4);
  go_on(Motion::few, 6);
  go_on(Motion::slow, 6);
  Spheres mirrored = frames.back();
  for (Sphere& s : mirrored) s.x = -s.x;
  frames.push_back(mirrored);
  go_on(Motion::slow, 4);
  return frames;
}

/// A few spheres fly off in all directions, through many cells a frame, and leave the plan's box.
inline Frames fly_off() {
  Frames frames = played("gas:n=1500", Motion::slow, 12);
  for (std::size_t f = 1; f < frames.size(); ++f) {
    for (std::size_t i = 0; i < 26; ++i) {
      const float far = static_cast<float>(f) * 1.3F;
      Sphere& s = frames[f][i * 50];
      s = frames[0][i * 50];
      s.x += far * static_cast<float>(static_cast<int>(i + 1) % 3 - 1);
      s.y += far * static_cast<float>(static_cast<int>(i + 1) / 3 % 3 - 1);
      s.z += far * static_cast<float>(static_cast<int>(i + 1) / 9 % 3 - 1);
    }
  }
  return frames;
}

/// Spheres so far apart that ids wrap on every axis.
inline Frames wrapped(Motion motion) {
  Spheres start = generate("gas:n=1000").spheres;
  for (std::size_t i = 0; i < start.size(); i += 2) {
    Sphere& s = start[i];
    s = {s.x + 1e10F, s.y + 1e10F, s.z - 1e10F, 300.0F};
  }
  return move(start, motion, 10, 1);
}

/// A line of spheres so long that its columns wrap; some jump from end to end.
inline Frames along_a_line() {
  Spheres start;
  for (int k = 0; k < 1500; ++k) start.push_back({static_cast<float>(k) * 1e7F, 0, 0, 0.5F});
  for (std::size_t k = 0; k < 750; ++k) start[2 * k + 1].x = start[2 * k].x + 0.5F;
  Frames frames = {start};
  for (std::size_t f = 1; f < 8; ++f) {
    Spheres next = frames.back();
    for (std::size_t k = f; k < next.size(); k += 97) std::swap(next[k], next[next.size() - 1 - k]);
    frames.push_back(next);
  }
  return frames;
}

/// Couples far from each other, each of two spheres that approach over gaps of all widths. Whatever
/// the width of a skin, some were not near when the list was made and meet before it is used up.
inline Frames couples_that_meet() {
  constexpr int kCouples = 300;
  Frames frames(100);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (int c = 0; c < kCouples; ++c) {
      const float half_gap = 0.0015F * static_cast<float>(c) - 0.004F * static_cast<float>(f);
      const auto y = static_cast<float>(3 * (c % 20));
      const auto z = static_cast<float>(3 * (c / 20));
      frames[f].push_back({-0.5F - half_gap, y, z, 0.5F});
      frames[f].push_back({0.5F + half_gap, y, z, 0.5F});
    }
  }
  return frames;
}

/// Spheres appear and disappear.
inline Frames numbers_change() {
  Frames frames = played("gas:n=1500", Motion::few, 8);
  frames[3].resize(1400);
  frames[4].resize(1400);
  frames[6].clear();
  return frames;
}

struct Sequence {
  std::string name;
  Frames frames;
};

inline std::vector<Sequence> sequences() {
  std::vector<Sequence> all;
  for (const char* spec : {"gas:n=1500", "dense:n=1000", "poly:n=1500", "giant:n=1000",
                           "lattice:n=1000", "identical:n=60", "discs:n=1000", "gas:n=5"}) {
    for (const Motion motion : {Motion::brownian, Motion::slow, Motion::few}) {
      const std::string_view name = kMotionNames[static_cast<std::size_t>(motion)];
      all.push_back({std::string(spec) + " " + std::string(name), played(spec, motion)});
    }
  }
  for (const char* spec : {"gas:n=1500", "poly:n=1500", "giant:n=1000"}) {
    all.push_back({std::string(spec) + ", a few teleport", teleports(spec, 0.02)});
    all.push_back({std::string(spec) + ", all teleport", teleports(spec, 1.0)});
  }
  all.push_back({"still", played("dense:n=1000", Motion::still)});
  all.push_back({"still, levels", played("giant:n=1000", Motion::still)});
  all.push_back({"a few by an ulp", by_an_ulp(0.05)});
  all.push_back({"all by an ulp", by_an_ulp(1.0)});
  all.push_back({"a few radii", radii_change(0.05, false)});
  all.push_back({"a few radii, slow", radii_change(0.02, true)});
  all.push_back({"A-B-A", a_b_a()});
  all.push_back({"moods", moods()});
  all.push_back({"flying off", fly_off()});
  all.push_back({"wrapped, slow", wrapped(Motion::slow)});
  all.push_back({"wrapped, few", wrapped(Motion::few)});
  all.push_back({"along a line", along_a_line()});
  all.push_back({"couples that meet", couples_that_meet()});
  all.push_back({"numbers change", numbers_change()});
  return all;
}

}  // namespace octocell
