// SPDX-License-Identifier: MIT
// FCL's SaPCollisionManager: end points in linked lists, which stay sorted from step to step, and a
// list of the pairs whose boxes meet.
#include <fcl/broadphase/broadphase_SaP.h>

#include <cstddef>
#include <cstdint>
#include <memory>

#include "baselines/baselines.hpp"
#include "baselines/fcl/fcl_finder.hpp"
#include "baselines/fcl/sweep.hpp"

namespace octocell::baselines {
namespace {

class Sap final : public FclFinder<fcl::SaPCollisionManagerd> {
  std::uint64_t pairs_ahead() override { return sweep_pairs(spheres(), SweepAlong::longest); }

  // Unless both ends of a box move the same way on every axis, update() drops an end point from its
  // list and links it to itself. So boxes that grow or shrink need a new structure.
  bool can_follow(SceneView scene) override {
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
      if (!moves_whole(*objects().pointers()[i], scene.spheres[i])) return false;
    }
    return true;
  }

  // If radii are equal, only rounding can hold one end back.
  static bool moves_whole(const FclObjects::Object& object, const Sphere& s) {
    const double r = s.r;
    if (FclObjects::radius(object) != r) return false;
    const auto& box = object.getAABB();
    const double centre[3] = {s.x, s.y, s.z};
    for (int axis = 0; axis < 3; ++axis) {
      const auto low = centre[axis] - r <=> box.min_[axis];
      const auto high = centre[axis] + r <=> box.max_[axis];
      if (low != high) return false;
    }
    return true;
  }
};

}  // namespace

std::unique_ptr<PairFinder> make_fcl_sap() { return std::make_unique<Sap>(); }

}  // namespace octocell::baselines
