// SPDX-License-Identifier: MIT
// Random numbers and functions with the same bits on every machine. They use integers and float64 +
// - * / sqrt, which IEEE 754 rounds in exactly one way. Logarithms, powers and cosines of the C
// library differ in their last bits between machines, so no generator may call them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/ieee754.hpp"

namespace octocell {

/// splitmix64 (Steele, Lea, Flood, OOPSLA 2014, fig. 17): the k-th number is a mix of start + k *
/// gamma.
class Random {
 public:
  /// Mixes the seed, so that neighbouring seeds have independent streams.
  explicit Random(std::uint64_t seed) : state_(mix(seed + kGamma)) {}

  std::uint64_t bits() { return mix(state_ += kGamma); }

  /// Returns a multiple of 2^-53 in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Returns a number in 0 .. bound - 1, uneven by less than 2^-21. Needs bound < 2^32.
  std::size_t below(std::size_t bound) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(bound));
  }

  /// Returns a number with mean 0 and variance 1, in (-6, 6): the sum of twelve uniform numbers
  /// (Irwin-Hall).
  double bell() {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += uniform();
    return sum;
  }

 private:
  static constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15u;

  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

/// Returns the cube root of a finite value >= 0, to a few units in the last place.
inline double cube_root(double value) {
  if (value == 0.0) return 0.0;
  double scale = 1.0;
  for (; value >= 8.0; value *= 0.125) scale *= 2.0;
  for (; value < 1.0; value *= 8.0) scale *= 0.5;
  double root = 1.5;  // of a value in [1, 8); Newton's method converges within six steps from here
  for (int step = 0; step < 8; ++step) root = (2.0 * root + value / (root * root)) / 3.0;
  return scale * root;
}

/// Computes base^t for many t in [0, 1): the product of base^(1/2), base^(1/4), ... over the bits
/// of t.
class PowerTable {
 public:
  explicit PowerTable(double base) {
    for (double& root : roots_) root = base = std::sqrt(base);
  }

  [[nodiscard]] double operator()(double t) const {
    double power = 1.0;
    for (const double root : roots_) {
      t += t;
      if (t < 1.0) continue;
      t -= 1.0;
      power *= root;
    }
    return power;
  }

 private:
  double roots_[32];  // 32 bits of t: far below a float32's last place
};

}  // namespace octocell
