// SPDX-License-Identifier: MIT
// A box as the search for images needs it: its vectors, the dual ones, and how far those are off.
#pragma once

#include <cstdint>

#include "include/octocell/box.hpp"

namespace octocell {

/// Along axis a, a place p lies g[a] . p boxes from the origin. The dual vectors g are rounded;
/// proofs use only how far they are off.
struct PeriodicBox {
  double h[3][3];      // the vectors; unit vectors across them for axes that do not repeat
  double g[3][3];      // nearly g[a] . h[b] = 1 if a == b, otherwise 0
  double g_length[3];  // at least |g[a]|
  double skew[3];      // at least the sum of |g[a] . h[b] - (a == b)| over the periodic axes b
  double volume;       // of the box
  bool periodic[3];
  [[nodiscard]] bool repeats() const { return periodic[0] || periodic[1] || periodic[2]; }
};

/// Throws InputError if a vector is not finite, or if the periodic ones lie in one plane or on one
/// line, or so nearly that float64 cannot tell.
PeriodicBox prepare(const Box& box);

}  // namespace octocell
