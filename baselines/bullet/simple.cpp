// SPDX-License-Identifier: MIT
// Bullet's btSimpleBroadphase: every box against every other, in every step.
#include <BulletCollision/BroadphaseCollision/btSimpleBroadphase.h>

#include <algorithm>
#include <cstddef>
#include <memory>

#include "baselines/baselines.hpp"
#include "baselines/bullet/pool_finder.hpp"

namespace octocell::baselines {
namespace {

class Simple final : public PoolFinder<btSimpleBroadphase> {
  std::unique_ptr<btSimpleBroadphase> make_broadphase() override {
    return std::make_unique<btSimpleBroadphase>(
        static_cast<int>(std::max<std::size_t>(spheres().size(), 1)));
  }
};

}  // namespace

std::unique_ptr<PairFinder> make_bullet_simple() { return std::make_unique<Simple>(); }

}  // namespace octocell::baselines
