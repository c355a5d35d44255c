// SPDX-License-Identifier: MIT
// Bullet's two axis sweeps. They differ in the width of their integers.
#pragma once

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>

#include "baselines/bullet/pool_finder.hpp"
#include "baselines/bullet/world_box.hpp"

namespace octocell::baselines {

template <class Sweep, class Integer>
class AxisSweepFinder : public PoolFinder<Sweep> {
 protected:
  using PoolFinder<Sweep>::spheres;

  void make_objects() override {
    world_.emplace(spheres());
    PoolFinder<Sweep>::make_objects();
  }

 private:
  // Without the last argument, the sweep also keeps a btDbvt for rays.
  std::unique_ptr<Sweep> make_broadphase() override {
    const auto handles = static_cast<Integer>(std::max<std::size_t>(spheres().size(), 2));
    return std::make_unique<Sweep>(world_->lowest(), world_->highest(), handles, nullptr, true);
  }

  bool can_follow(SceneView scene) override {
    return std::ranges::all_of(scene.spheres, [this](const Sphere& s) { return world_->holds(s); });
  }

  std::optional<WorldBox> world_;
};

}  // namespace octocell::baselines
