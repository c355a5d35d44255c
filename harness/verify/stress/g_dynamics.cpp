// SPDX-License-Identifier: MIT
// G. Dynamics and state: what moved, what did not, and what was there before.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/verify/stress/make.hpp"

namespace octocell::stress {
namespace {

/// Makes a gas between two spheres at opposite corners, so that a plan's box holds for all frames.
Spheres anchored(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_root(static_cast<double>(n)) * 1.2;
  const auto end = static_cast<float>(side);
  Spheres spheres = {{0, 0, 0, 0.5F}, {end, end, end, 0.5F}};
  while (spheres.size() < std::max<std::size_t>(n, 4)) {
    const float x = in(random, 0, side);
    const float y = in(random, 0, side);
    spheres.push_back({x, y, in(random, 0, side), 0.5F});
  }
  return spheres;
}

/// The last of `frames` becomes the scene; the others come before it.
Case moving_case(std::string name, std::vector<Spheres> frames) {
  Case moving = {.name = std::move(name)};
  moving.spheres = std::move(frames.back());
  frames.pop_back();
  moving.before = std::move(frames);
  return moving;
}

std::vector<Case> rest(std::size_t n) {
  const Spheres still = anchored(n, 36);
  Spheres one_moved = still;
  one_moved[n / 2].x = nudged(one_moved[n / 2].x, 1);
  // Two spheres that touch, and that are apart after a move of an ulp.
  Spheres touching = scene("lattice", n);
  Spheres apart = touching;
  apart[n / 2].x = nudged(apart[n / 2].x, 1);
  return {moving_case("nothing moves", {still, still, still}),
          moving_case("one moves by an ulp", {still, still, one_moved}),
          moving_case("a contact ends by an ulp", {touching, touching, apart}),
          moving_case("a contact begins by an ulp", {apart, apart, touching})};
}

std::vector<Case> teleports(std::size_t n) {
  std::vector<Spheres> frames;
  for (const std::uint64_t seed : {1, 2, 3, 4}) frames.push_back(anchored(n, seed));
  Spheres exchanged = frames[0];
  std::reverse(exchanged.begin() + 2, exchanged.end());
  return {moving_case("everything, each frame", frames),
          moving_case("there and back", {frames[0], frames[1], frames[0]}),
          moving_case("places exchanged", {frames[0], exchanged})};
}

/// The finder has searched other scenes before: larger and smaller, harder and easier ones.
std::vector<Case> stale_state(std::size_t n) {
  const Spheres a = scene("gas", n);
  const Spheres b = scene("lattice", 2 * n, "shuffle=1");
  return {{.name = "A B A", .spheres = a, .before = {a, b}},
          {.name = "B A B", .spheres = b, .before = {b, a}},
          {.name = "after none", .spheres = a, .before = {{}}},
          {.name = "after one cell", .spheres = a, .before = {Spheres(300, {0, 0, 0, 0.5F})}},
          {.name = "none, after all", .spheres = {}, .before = {a, b}},
          {.name = "small after wide", .spheres = scaled(a, 1e-20F), .before = {scaled(a, 1e20F)}}};
}

std::vector<Case> churn(std::size_t n) {
  Spheres all = anchored(n, 39);
  Spheres half(all.begin(), all.begin() + static_cast<long>(all.size() / 2));
  Spheres regrown = joined(half, anchored(n / 2, 40));
  return {{.name = "half removed", .spheres = half, .before = {all}},
          {.name = "removed and made again", .spheres = regrown, .before = {all, half}},
          {.name = "ids permuted", .spheres = shuffled(all, 39), .before = {all}}};
}

Flags random_flags(Random& random) {
  constexpr std::uint32_t kGroups = 3;
  const std::uint32_t group = 1U << random.below(kGroups);
  const auto mask = static_cast<std::uint32_t>(random.below(1U << kGroups));
  const bool standing = random.below(2) == 0;
  return make_flags(standing, group, mask);
}

std::vector<Case> flagged(std::size_t n) {
  Random random(40);
  Case some = {.name = "at random", .spheres = scene("dense", n)};
  Case touching = {.name = "at random, all tangent", .spheres = scene("lattice", n)};
  for (Case* c : {&some, &touching}) {
    for (std::size_t i = 0; i < c->spheres.size(); ++i) c->flags.push_back(random_flags(random));
  }
  Case none = {.name = "all static", .spheres = some.spheres, .pair_count = 0};
  none.flags.assign(none.spheres.size(), make_flags(true, 1, kMaxMask));
  return {some, touching, none};
}

constexpr Entry kDynamics[] = {
    {"G36", "all at rest, then one moves by an ulp", {500, 5000, 100000}, rest, Ask::frames},
    {"G37", "everything elsewhere in each frame", {500, 5000, 100000}, teleports, Ask::frames},
    {"G38",
     "the same finder, other scenes before",
     {500, 5000, 100000},
     stale_state,
     Ask::other_scenes},
    {"G39", "spheres removed, made, and renumbered", {500, 5000, 100000}, churn, Ask::other_scenes},
    {"G40", "static spheres, groups and masks", {500, 5000, 100000}, flagged},
};

}  // namespace

std::span<const Entry> dynamics() { return kDynamics; }

}  // namespace octocell::stress
