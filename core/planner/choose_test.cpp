// SPDX-License-Identifier: MIT
// Chooses the test that a scene needs for the predicate that the user chose.
#include <algorithm>
#include <cmath>

#include "core/planner/choose_test.hpp"

namespace octocell {
namespace {

PairTest exact_test(const SceneStats& stats, const PlanOptions& options) {
  const PlanFacts& facts = stats.facts;
  const Skips allowed = options.allowed;
  // Spheres that move do not stay on a lattice.
  if (facts.lattice_units_per_length != 0.0 && allowed.has(Skip::uncertain_pairs) &&
      !options.moving) {
    return PairTest::f32;
  }
  if (!allowed.has(Skip::safe_filter)) return PairTest::filter_safe;
  if (facts.r_max == 0.0F) return PairTest::filter_fast;
  if (facts.r_min_nonzero < kFastRadiusMin || facts.r_max > kFastRadiusMax) {
    return PairTest::filter_safe;
  }
  const bool equal = facts.r_min == facts.r_max && allowed.has(Skip::equal_radii);
  return equal ? PairTest::filter_equal : PairTest::filter_fast;
}

/// Returns the exponent of the finest unit in which `length` is at most 2^most_units_log2 units.
int unit_exponent(double length, int most_units_log2) {
  int exponent = 0;
  std::frexp(length, &exponent);  // length < 2^exponent
  return std::clamp(exponent - most_units_log2, -126, 126);
}

}  // namespace

PairTest choose_test(const SceneStats& stats, const PlanOptions& options) {
  switch (options.predicate) {
    case Predicate::exact:
      return exact_test(stats, options);
    case Predicate::f32:
      return PairTest::f32;
    case Predicate::f32_sqrt:
      return PairTest::f32_sqrt;
    case Predicate::f64:
      return PairTest::f64;
    case Predicate::aabb_only:
      return PairTest::boxes;
    case Predicate::f16_cell:
      return PairTest::f16;
    case Predicate::q16_cell:
      return PairTest::q16;
    case Predicate::q16_exact:
      return PairTest::q16_exact;
    case Predicate::gram_f32:
      break;
  }
  return PairTest::gram;
}

PlanFacts needed_facts(PlanFacts facts, Predicate predicate, PairTest test) {
  if (test != PairTest::filter_equal) facts.r_min = 0.0F;
  if (predicate != Predicate::exact || has_uncertain_pairs(test))
    facts.lattice_units_per_length = 0.0;
  return facts;
}

Packing choose_packing(const PlanFacts& facts, PairTest test) {
  if (!is_packed(test)) return {};
  double widest = 2.0 * static_cast<double>(facts.r_max);
  if (widest == 0.0) {  // points: only equal ones are pairs, so any unit is right
    for (int a = 0; a < 3; ++a) {
      widest = std::max(widest, static_cast<double>(facts.highest[a]) - facts.lowest[a]);
    }
  }
  // The sum of two radii is at most a quarter of the cell: 2^16 units of integers, 4 of floats.
  const int exponent = unit_exponent(widest, test == PairTest::f16 ? 0 : 14);
  const double half_cell = std::ldexp(test == PairTest::f16 ? 2.0 : 32768.0, exponent);
  return {.units_per_length = static_cast<float>(std::ldexp(1.0, -exponent)),
          .half_cell = half_cell > kFloatMax ? HUGE_VALF : static_cast<float>(half_cell)};
}

}  // namespace octocell
