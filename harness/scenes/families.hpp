// SPDX-License-Identifier: MIT
// One function per generator; the table in scenes.cpp says what each makes. A generator computes in
// float64 and rounds each number once, at the end, to the number type of Sphere or DoubleSphere.
// All lengths are in units where the largest common sphere has radius 0.5.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/sphere.hpp"
#include "harness/scenes/parameters.hpp"
#include "harness/scenes/portable_math.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::families {

inline constexpr double kRadius = 0.5;

template <typename AnySphere>
std::vector<AnySphere> gas(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> shifted(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> poly(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> cluster(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> lattice(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> fcc(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> giant(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> discs(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> identical(const Parameters&);
template <typename AnySphere>
std::vector<AnySphere> chain(const Parameters&);

/// The type of a sphere's numbers.
template <typename AnySphere>
using NumberOf = decltype(AnySphere::r);

inline double sphere_volume(double r) { return 4.0 / 3.0 * std::numbers::pi * r * r * r; }

/// Returns the side of a cube in which `count` spheres of radius kRadius fill `volume_fraction`;
/// overlaps count twice.
inline double box_side(std::size_t count, double volume_fraction) {
  return cube_root(static_cast<double>(count) * sphere_volume(kRadius) / volume_fraction);
}

/// Returns a coordinate that is uniform in a cube (or its floor, z = 0) around `centre` on each
/// axis.
template <typename Number>
Number coordinate_in_box(Random& random, double side, double centre = 0.0) {
  return static_cast<Number>(centre + (random.uniform() - 0.5) * side);
}

/// Returns the coordinate of a lattice's plane number `steps` of `side` planes; the middle one lies
/// at zero.
template <typename Number>
Number coordinate_on_lattice(std::size_t steps, std::size_t side, double step) {
  return static_cast<Number>((static_cast<double>(steps) - static_cast<double>(side / 2)) * step);
}

}  // namespace octocell::families
