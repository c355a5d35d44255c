// SPDX-License-Identifier: MIT
// Tools for the families. As in harness/scenes, they use only operations with the same bits on
// every machine: + - * / sqrt, powers of two, and neighbouring floats.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "core/overlap.hpp"
#include "harness/scenes/portable_math.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/stress/catalogue.hpp"

namespace octocell::stress {

inline float nudged(float value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafter(value, kFloatMax);
  for (; ulps < 0; ++ulps) value = std::nextafter(value, -kFloatMax);
  return value;
}

/// Returns a number in -most .. most.
inline int step(Random& random, int most) {
  return static_cast<int>(random.below(static_cast<std::size_t>(2 * most + 1))) - most;
}

/// Returns any finite float; all bit patterns are equally likely.
inline float any_float(Random& random) {
  for (;;) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits() >> 32));
    if (std::isfinite(value)) return value;
  }
}

inline float in(Random& random, double low, double high) {
  return static_cast<float>(low + (high - low) * random.uniform());
}

/// Returns the side of a cube of at most n places.
inline int side_of(std::size_t n) {
  int side = 0;
  while (static_cast<std::size_t>(side + 1) * (side + 1) * (side + 1) <= n) ++side;
  return side;
}

/// Calls place(i, j, k) for 0 <= i, j, k < side.
template <typename Place>
Spheres lattice_of(int side, Place place) {
  Spheres spheres;
  for (int k = 0; k < side; ++k) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) spheres.push_back(place(i, j, k));
    }
  }
  return spheres;
}

template <typename Make>
Spheres repeated(std::size_t n, Make make) {
  Spheres spheres;
  spheres.reserve(n);
  for (std::size_t k = 0; k < n; ++k) spheres.push_back(make(k));
  return spheres;
}

/// Makes a scene of the generators: scene("gas", 1000, "seed=2").
inline Spheres scene(std::string_view name, std::size_t n, std::string_view more = {}) {
  std::string spec = std::string(name) + ":n=" + std::to_string(n);
  if (!more.empty()) spec.append(",").append(more);
  return generate(spec).spheres;
}

inline Spheres scaled(Spheres spheres, float factor) {
  for (Sphere& s : spheres) s = {s.x * factor, s.y * factor, s.z * factor, s.r * factor};
  return spheres;
}

inline Spheres moved(Spheres spheres, double x, double y, double z) {
  const auto sum = [](float a, double b) { return static_cast<float>(a + b); };
  for (Sphere& s : spheres) s = {sum(s.x, x), sum(s.y, y), sum(s.z, z), s.r};
  return spheres;
}

inline Spheres joined(Spheres a, const Spheres& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline Spheres shuffled(Spheres spheres, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t left = spheres.size(); left > 1; --left) {
    std::swap(spheres[left - 1], spheres[random.below(left)]);
  }
  return spheres;
}

}  // namespace octocell::stress
