// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/ieee754.hpp"
#include "include/octocell/types.hpp"

namespace octocell {

/// What a finder is given. The finder only reads it; it must stay valid until the next find_pairs()
/// ends.
struct SceneView {
  std::span<const Sphere> spheres;    // [count], count <= kMaxSpheres
  std::span<const Flags> flags = {};  // [count] by id; or empty: then every pair may collide
};

}  // namespace octocell
