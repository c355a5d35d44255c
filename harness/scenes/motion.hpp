// SPDX-License-Identifier: MIT
// Scenes that move: the three motions that are usual in broad-phase benchmarks, and four in which
// little happens. Recorded frames are in harness/files/frames.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/sphere.hpp"

namespace octocell {

enum class Motion : std::uint8_t { brownian, free_fall, gravity, slow, few, darts, still };
inline constexpr std::array<std::string_view, 7> kMotionNames = {
    "brownian", "free_fall", "gravity", "slow", "few", "darts", "still"};

/// Returns the motion of that name. Throws InputError that lists the known names.
Motion motion_named(std::string_view name);

/// The same spheres at successive times; frames[0] is the start. Radii and ids do not change.
using Frames = std::vector<std::vector<Sphere>>;

/// Returns `count` frames from `start` on, at least one. In the first frames, no step along an axis
/// is longer than 0.1 of the largest radius, except for darts. Same bits on every machine, like
/// generate().
///   brownian   independent uniform steps; walls of the starting box reflect
///   free_fall  constant acceleration down the z axis; the floor returns half of the speed
///   gravity    constant acceleration towards the middle of the starting box
///   slow       brownian with a tenth of the step
///   few        brownian, but only for a tenth of the spheres, the same in every frame
///   darts      a hundredth of the spheres, the same in every frame, by up to two radii along an
///   axis still      nothing moves
/// Spheres pass through one another: a broad phase reports pairs, it does not resolve them. Static
/// spheres stay where they are, and the others move as if there were no flags.
Frames move(const std::vector<Sphere>& start, Motion motion, int count, std::uint64_t seed,
            std::span<const Flags> flags = {});

}  // namespace octocell
