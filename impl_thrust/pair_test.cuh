// SPDX-License-Identifier: MIT
// The tests of two spheres, chosen as they run: here a branch that all work items take alike is
// cheaper to read than a kernel for each test.
#pragma once

#include "core/pair_test.hpp"

namespace octocell::on_thrust {

OCTOCELL_HD float stored_radius(PairTest test, float r) {
  if (!has_doubts(test)) return r;
  return test == PairTest::band_safe ? band_radius<Band::safe>(r) : band_radius<Band::fast>(r);
}

/// Both with stored radii.
OCTOCELL_HD bool may_overlap(PairTest test, const Sphere& p, const Sphere& q) {
  if (test == PairTest::f64) return pair_tests::within_f64(p, q);
  if (test == PairTest::f32_sqrt) return pair_tests::within_f32_sqrt(p, q);
  return band_may_overlap(p, q);
}

/// Of two that may overlap: is it certain, or taken for certain?
OCTOCELL_HD bool is_sure(PairTest test, const Sphere& p, const Sphere& q) {
  if (!has_doubts(test)) return true;
  return test == PairTest::band_safe ? band_is_sure<Band::safe>(p, q)
                                     : band_is_sure<Band::fast>(p, q);
}

}  // namespace octocell::on_thrust
