// SPDX-License-Identifier: MIT
// Space that repeats: the box, and which of its images two spheres meet in.
#pragma once

#include <compare>
#include <cstdint>

namespace octocell {

/// A scene that repeats. Its copies are moved by S[0] vector[0] + S[1] vector[1] + S[2] vector[2]
/// with any whole numbers S; S[a] is 0 for axes along which the scene does not repeat. The vectors
/// may have any lengths and angles, but those of periodic axes must not lie in one plane or on one
/// line. Vectors of other axes are not read.
struct Box {
  float vector[3][3];  // one row each: x, y, z
  bool periodic[3] = {true, true, true};
};

/// Whole multiples of the three vectors of a box.
struct Shift {
  std::int32_t a;
  std::int32_t b;
  std::int32_t c;
  friend constexpr auto operator<=>(const Shift&, const Shift&) = default;
};
static_assert(sizeof(Shift) == 12, "files and devices read shifts as rows of three integers");

}  // namespace octocell
