// SPDX-License-Identifier: MIT
// Puts the spheres in the order of their entries, so that spheres tested together are close in
// memory.
#pragma once

#include <thrust/transform.h>

#include "impl_thrust/pair_test.cuh"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {

/// Returns the sphere of an entry, with the radius that the pair test uses.
struct Gather {
  const Sphere* spheres;
  PairTest test;
  OCTOCELL_HD Sphere operator()(Object object) const {
    Sphere s = spheres[object & kIdMask];
    s.r = stored_radius(test, s.r);
    return s;
  }
};

template <typename System>
void gather_members(Workspace<System>& w) {
  const Object* const objects = w.objects.data();
  thrust::transform(w.system.policy(), objects, objects + w.entries(), w.members.data(),
                    Gather{w.spheres, w.plan.test});
}

}  // namespace octocell::on_thrust
