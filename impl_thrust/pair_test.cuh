// SPDX-License-Identifier: MIT
// The tests of two spheres, chosen at run time: here one branch, which all work items take alike,
// is simpler than a kernel for each test.
#pragma once

#include "core/precision.hpp"

namespace octocell::on_thrust {

OCTOCELL_HD float stored_radius(PairTest test, float r) {
  if (!has_uncertain_pairs(test)) return r;
  return test == PairTest::filter_safe ? filter_radius<Filter::safe>(r)
                                       : filter_radius<Filter::fast>(r);
}

/// Both spheres have stored radii.
OCTOCELL_HD bool may_overlap(PairTest test, const Sphere& p, const Sphere& q) {
  if (test == PairTest::f64) return pair_tests::within_f64(p, q);
  if (test == PairTest::f32_sqrt) return pair_tests::within_f32_sqrt(p, q);
  return filter_may_overlap(p, q);
}

/// Returns true if a pair that may overlap certainly does, or if the test takes it as certain.
OCTOCELL_HD bool is_sure(PairTest test, const Sphere& p, const Sphere& q) {
  if (!has_uncertain_pairs(test)) return true;
  return test == PairTest::filter_safe ? filter_is_sure<Filter::safe>(p, q)
                                       : filter_is_sure<Filter::fast>(p, q);
}

}  // namespace octocell::on_thrust
