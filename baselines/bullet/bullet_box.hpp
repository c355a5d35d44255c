// SPDX-License-Identifier: MIT
// Bullet's boxes, in float like the packaged library.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <algorithm>

#include "core/overlap.hpp"

#ifdef BT_USE_DOUBLE_PRECISION
#error "The packaged libBulletCollision is single precision; headers must agree with it."
#endif

namespace octocell::baselines {

struct BulletBox {
  btVector3 lowest;
  btVector3 highest;

  [[nodiscard]] btDbvtVolume volume() const { return btDbvtVolume::FromMM(lowest, highest); }
};

/// Returns p - r and p + r, rounded to nearest and kept finite. Both steps are monotone and Bullet
/// compares boxes with <=, so boxes of overlapping spheres still meet: p + r >= q - s also holds
/// after rounding.
inline BulletBox bullet_box(const Sphere& s) {
  const auto finite = [](float v) { return std::clamp(v, -kFloatMax, kFloatMax); };
  return {{finite(s.x - s.r), finite(s.y - s.r), finite(s.z - s.r)},
          {finite(s.x + s.r), finite(s.y + s.r), finite(s.z + s.r)}};
}

}  // namespace octocell::baselines
