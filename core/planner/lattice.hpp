// SPDX-License-Identifier: MIT
// Finds scenes whose numbers are all multiples of one power of two and have few bits. Float32 then
// computes as exactly as integers do: nothing is rounded where it matters (docs/exactness.md, the
// lattice certificate). A lattice is given as units per length, 2^-g.
#pragma once

#include <span>

#include "core/sphere.hpp"

namespace octocell {

/// Returns the lattice that all spheres lie on if, on this lattice, D <= R computed in float32 is
/// right for all pairs: sums of radii are below 2^12 units, and squares neither overflow nor
/// underflow. Returns 0 if there is none. The lattice is guessed from `few` and proved for `all`;
/// if `few` already show that there is none, the others are not read.
double find_lattice(std::span<const Sphere> few, std::span<const Sphere> all, float r_max);

}  // namespace octocell
