// SPDX-License-Identifier: MIT
// The spheres in the order of their entries, so that what is tested together lies together.
#pragma once

#include <thrust/transform.h>

#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {

/// The sphere of an entry, with the radius that level 1 of the predicate uses.
struct Gather {
  const Sphere* spheres;
  Band band;
  OCTOCELL_HD Sphere operator()(Object object) const {
    Sphere s = spheres[object & kIdMask];
    s.r = band == Band::fast ? band_radius<Band::fast>(s.r) : band_radius<Band::safe>(s.r);
    return s;
  }
};

template <typename System>
void gather_members(Workspace<System>& w) {
  const Object* const objects = w.objects.data();
  thrust::transform(w.system.policy(), objects, objects + w.entries(), w.members.data(),
                    Gather{w.spheres, w.plan.band});
}

}  // namespace octocell::on_thrust
