// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "harness/interface/ieee754.hpp"

namespace octocell {

/// One sphere, in the scene's own unit of length. Valid: all four finite, r >= 0.
struct Sphere {
  float x;
  float y;
  float z;
  float r;
};
static_assert(sizeof(Sphere) == 16, "files and devices read spheres as rows of four floats");

/// Sphere ids share a word with four control bits, so ids have 28 bits.
inline constexpr std::uint64_t kMaxSpheres = std::uint64_t{1} << 28;

/// What a finder is given. It is only looked at; it must outlive the finder's next find_pairs().
struct SceneView {
  std::span<const Sphere> spheres;  // [count], count <= kMaxSpheres
};

}  // namespace octocell
