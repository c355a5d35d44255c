// SPDX-License-Identifier: MIT
// Scenes whose numbers are all multiples of one power of two, so few bits wide that float32
// computes with them as with integers: nothing is rounded where it would matter (docs/exactness.md,
// the lattice certificate). A lattice is given as units per length, 2^-g.
#pragma once

#include <span>

#include "core/sphere.hpp"

namespace octocell {

/// The lattice that all spheres lie on, if D <= R, computed in float32, is right on it for all
/// pairs: sums of radii are below 2^12 units, and squares neither overflow nor underflow. Else 0.
/// It is read off a few spheres, and proved for all; where the few show that there is none, no
/// others are looked at.
double find_lattice(std::span<const Sphere> few, std::span<const Sphere> all, float r_max);

}  // namespace octocell
