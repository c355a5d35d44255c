// SPDX-License-Identifier: MIT
// Float64 numbers and the float32 spheres that they are rounded to: which decisions differ?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "include/octocell/octocell.hpp"

namespace octocell::python {

struct Sphere64 {
  double x;
  double y;
  double z;
  double r;
};
static_assert(sizeof(Sphere64) == 32, "NumPy's rows of four float64 are read as such");

struct Point64 {
  double x;
  double y;
  double z;
};
static_assert(sizeof(Point64) == 24, "NumPy's rows of three float64 are read as such");

/// Spheres rounded to float32, and the same spheres with wider radii.
struct Rounded {
  std::vector<Sphere> nearest;
  /// Every two spheres that overlap, with or without rounding, overlap here.
  std::vector<Sphere> wide;
};

/// Throws Error invalid_sphere if a number is not finite as float32, or r < 0.
Rounded rounded(std::span<const Sphere64> spheres);

/// How the pairs of rounded spheres differ from those of the float64 numbers, over the reals.
struct Changed {
  std::uint64_t lost = 0;    // pairs that rounding parts
  std::uint64_t gained = 0;  // pairs that rounding makes
};

/// `found` are the pairs of the rounded spheres and `wide` those of the wide ones, both sorted.
Changed changed(std::span<const Sphere64> spheres, std::span<const Pair> found,
                std::span<const Pair> wide);

/// Writes for each pair whether the distance is at most `limit`, or less than it if `strict`, over
/// the reals. There is one limit for each pair, or one for all; within a negative one lies nothing.
void near(std::span<const Point64> points, std::span<const Pair> pairs,
          std::span<const double> limits, bool strict, std::span<bool> result);

}  // namespace octocell::python
