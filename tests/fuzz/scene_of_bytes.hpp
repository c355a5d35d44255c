// SPDX-License-Identifier: MIT
// Any bytes as a small scene, so that a fuzzer can look for the one that breaks a backend.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/sphere.hpp"

namespace octocell::fuzz {

struct FuzzScene {
  std::vector<Sphere> spheres;      // all valid, at most kMostSpheres
  std::optional<double> cell_side;  // of rule lowest_cell; none: the planner's choice
  int threads = 1;
  bool no_room = false;  // begin with buffers of no size
};

inline constexpr std::size_t kMostSpheres = 96;

/// The first bytes choose how the others are read (raw bits, lattices, borders of cells, ...).
FuzzScene scene_of(std::span<const std::uint8_t> bytes);

}  // namespace octocell::fuzz
