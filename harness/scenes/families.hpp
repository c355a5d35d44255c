// SPDX-License-Identifier: MIT
// One function per generator; the table in scenes.cpp says what each makes. A generator computes in
// float64. All lengths are in units where the largest common sphere has radius 0.5.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "core/sphere.hpp"
#include "harness/scenes/parameters.hpp"
#include "harness/scenes/portable_math.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::families {

inline constexpr double kRadius = 0.5;

struct Centre {
  double x;
  double y;
  double z;
};

/// The spheres that a generator makes. Each number is rounded to float32 once; what it was before
/// is kept if the caller wants it.
class GeneratedSpheres {
 public:
  GeneratedSpheres(std::size_t count, bool keeps_unrounded)
      : rounded_(count), unrounded_(keeps_unrounded ? count : 0) {}

  [[nodiscard]] std::size_t size() const { return rounded_.size(); }

  void put(std::size_t i, const DoubleSphere& s) {
    put_centre(i, {s.x, s.y, s.z});
    put_radius(i, s.r);
  }
  void put_centre(std::size_t i, const Centre& c) {
    rounded_[i] = {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z),
                   rounded_[i].r};
    if (!unrounded_.empty()) unrounded_[i] = {c.x, c.y, c.z, unrounded_[i].r};
  }
  void put_radius(std::size_t i, double r) {
    rounded_[i].r = static_cast<float>(r);
    if (!unrounded_.empty()) unrounded_[i].r = r;
  }
  void swap(std::size_t i, std::size_t j) {
    std::swap(rounded_[i], rounded_[j]);
    if (!unrounded_.empty()) std::swap(unrounded_[i], unrounded_[j]);
  }

  std::vector<Sphere> take_rounded() { return std::move(rounded_); }
  std::vector<DoubleSphere> take_unrounded() { return std::move(unrounded_); }

 private:
  std::vector<Sphere> rounded_;
  std::vector<DoubleSphere> unrounded_;  // or empty
};

void gas(const Parameters& parameters, GeneratedSpheres& spheres);
void shifted(const Parameters& parameters, GeneratedSpheres& spheres);
void poly(const Parameters& parameters, GeneratedSpheres& spheres);
void cluster(const Parameters& parameters, GeneratedSpheres& spheres);
void lattice(const Parameters& parameters, GeneratedSpheres& spheres);
void fcc(const Parameters& parameters, GeneratedSpheres& spheres);
void giant(const Parameters& parameters, GeneratedSpheres& spheres);
void discs(const Parameters& parameters, GeneratedSpheres& spheres);
void identical(const Parameters& parameters, GeneratedSpheres& spheres);
void chain(const Parameters& parameters, GeneratedSpheres& spheres);

inline double sphere_volume(double r) { return 4.0 / 3.0 * std::numbers::pi * r * r * r; }

/// Returns the side of a cube in which `count` spheres of radius kRadius fill `volume_fraction`;
/// overlaps count twice.
inline double box_side(std::size_t count, double volume_fraction) {
  return cube_root(static_cast<double>(count) * sphere_volume(kRadius) / volume_fraction);
}

/// Returns a coordinate that is uniform in a cube (or its floor, z = 0) around `centre` on each
/// axis.
inline double coordinate_in_box(Random& random, double side, double centre = 0.0) {
  return centre + (random.uniform() - 0.5) * side;
}

/// Returns the coordinate of a lattice's plane number `steps` of `side` planes; the middle one lies
/// at zero.
inline double coordinate_on_lattice(std::size_t steps, std::size_t side, double step) {
  return (static_cast<double>(steps) - static_cast<double>(side / 2)) * step;
}

}  // namespace octocell::families
