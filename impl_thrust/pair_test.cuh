// SPDX-License-Identifier: MIT
// The tests of two spheres, chosen as they run: here a branch that all work items take alike is
// cheaper to read than a kernel for each test.
#pragma once

#include "core/pair_test.hpp"

namespace octocell::on_thrust {

OCTOCELL_HD float stored_radius(PairTest test, float r) {
  if (!has_uncertain_pairs(test)) return r;
  return test == PairTest::filter_safe ? filter_radius<Filter::safe>(r)
                                       : filter_radius<Filter::fast>(r);
}

/// Both with stored radii.
OCTOCELL_HD bool may_overlap(PairTest test, const Sphere& p, const Sphere& q) {
  if (test == PairTest::f64) return pair_tests::within_f64(p, q);
  if (test == PairTest::f32_sqrt) return pair_tests::within_f32_sqrt(p, q);
  return filter_may_overlap(p, q);
}

/// Of two that may overlap: is it certain, or taken for certain?
OCTOCELL_HD bool is_sure(PairTest test, const Sphere& p, const Sphere& q) {
  if (!has_uncertain_pairs(test)) return true;
  return test == PairTest::filter_safe ? filter_is_sure<Filter::safe>(p, q)
                                       : filter_is_sure<Filter::fast>(p, q);
}

}  // namespace octocell::on_thrust
