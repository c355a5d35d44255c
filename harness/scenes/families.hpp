// SPDX-License-Identifier: MIT
// One function per generator; the table in scenes.cpp says what each makes.
// All lengths are in radii of the largest common sphere, which is 0.5 throughout.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "harness/interface/sphere.hpp"
#include "harness/scenes/parameters.hpp"
#include "harness/scenes/portable_math.hpp"

namespace octocell::families {

inline constexpr double kRadius = 0.5;

std::vector<Sphere> gas(const Parameters&);
std::vector<Sphere> shifted(const Parameters&);
std::vector<Sphere> poly(const Parameters&);
std::vector<Sphere> cluster(const Parameters&);
std::vector<Sphere> lattice(const Parameters&);
std::vector<Sphere> giant(const Parameters&);
std::vector<Sphere> discs(const Parameters&);
std::vector<Sphere> identical(const Parameters&);
std::vector<Sphere> chain(const Parameters&);

inline double sphere_volume(double r) { return 4.0 / 3.0 * std::numbers::pi * r * r * r; }

/// The side of a cube of which `count` spheres of radius kRadius fill `volume_fraction`,
/// overlaps counted twice.
inline double box_side(std::size_t count, double volume_fraction) {
  return cube_root(static_cast<double>(count) * sphere_volume(kRadius) / volume_fraction);
}

/// Uniform in a cube (or its floor, z = 0) around `centre` on each axis.
inline float coordinate_in_box(Random& random, double side, double centre = 0.0) {
  return static_cast<float>(centre + (random.uniform() - 0.5) * side);
}

}  // namespace octocell::families
