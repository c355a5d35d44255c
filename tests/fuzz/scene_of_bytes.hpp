// SPDX-License-Identifier: MIT
// Turns any bytes into a small scene, so that a fuzzer can search for one that breaks a backend.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/sphere.hpp"

namespace octocell::fuzz {

struct FuzzScene {
  std::vector<Sphere> spheres;      // all valid, at most kMostSpheres
  std::optional<double> cell_side;  // for rule lowest_cell; none: the planner chooses
  int threads = 1;
  bool no_room = false;  // begins with buffers of size zero
};

inline constexpr std::size_t kMostSpheres = 96;

/// Makes a scene. The first bytes choose how the others are read (raw bits, lattices, borders of
/// cells, ...).
FuzzScene scene_of(std::span<const std::uint8_t> bytes);

}  // namespace octocell::fuzz
