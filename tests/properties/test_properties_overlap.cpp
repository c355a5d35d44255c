// SPDX-License-Identifier: MIT
// Each level of the predicate is right if it is certain, for any two finite spheres.
#include <gtest/gtest.h>

// needs the above
#include <rapidcheck/gtest.h>

#include "core/overlap.hpp"
#include "tests/properties/generators.hpp"
#include "tests/properties/oracle.hpp"

namespace octocell {
namespace {

using properties::any_pair;
using properties::Two;

template <Filter filter>
void expect_no_loss_and_sure_verdicts(const Two& two) {
  const bool truth = properties::overlap(two.a, two.b);
  const Verdict verdict = filter_verdict<filter>(two.a, two.b);
  RC_ASSERT(verdict != Verdict::apart || !truth);
  RC_ASSERT(verdict != Verdict::overlap || truth);
  RC_ASSERT(verdict == filter_verdict<filter>(two.b, two.a));
  RC_CLASSIFY(verdict == Verdict::uncertain, "uncertain");
  RC_CLASSIFY(truth, "overlap");
}

RC_GTEST_PROP(PredicateProperties, SafeFilterLosesNoPairAndIsRightWhenSure, ()) {
  expect_no_loss_and_sure_verdicts<Filter::safe>(*any_pair());
}

RC_GTEST_PROP(PredicateProperties, FastFilterLosesNoPairAndIsRightWhenSure, ()) {
  const Two two = *any_pair();
  if (!in_fast_range(two.a.r) || !in_fast_range(two.b.r)) RC_DISCARD("radii out of range");
  expect_no_loss_and_sure_verdicts<Filter::fast>(two);
}

RC_GTEST_PROP(PredicateProperties, FastFilterDecidesNoPointsThatAreOne, ()) {
  const Sphere point = {*properties::any_float(), *properties::any_float(),
                        *properties::any_float(), 0.0F};
  RC_ASSERT(filter_may_overlap(point, point));
  RC_ASSERT(!filter_is_sure<Filter::fast>(point, point));
}

RC_GTEST_PROP(PredicateProperties, Float64IsRightWhenCertain, ()) {
  const Two two = *any_pair();
  const Verdict verdict = exact::float64_test(two.a, two.b);
  RC_CLASSIFY(verdict == Verdict::uncertain, "uncertain");
  if (verdict == Verdict::uncertain) return;
  RC_ASSERT((verdict == Verdict::overlap) == properties::overlap(two.a, two.b));
}

RC_GTEST_PROP(PredicateProperties, IntegersAreAlwaysRight, ()) {
  const Two two = *any_pair();
  RC_ASSERT(exact::integer_test(two.a, two.b) == properties::overlap(two.a, two.b));
}

RC_GTEST_PROP(PredicateProperties, ExactTestIsRightInEitherOrder, ()) {
  const Two two = *any_pair();
  const bool truth = properties::overlap(two.a, two.b);
  RC_ASSERT(overlap_exact(two.a, two.b) == truth);
  RC_ASSERT(overlap_exact(two.b, two.a) == truth);
}

/// The errors of TwoSum and of the product are exactly what rounding took.
RC_GTEST_PROP(PredicateProperties, ErrorsOfSumsAndSquaresAreExact, ()) {
  const double a = *properties::any_float();
  const double b = *properties::any_float();
  const exact::Sum<double> sum = exact::two_sum(a, b);
  const auto exactly = properties::exactly;
  RC_ASSERT(exactly(a) + exactly(b) == exactly(sum.value) + exactly(sum.error));
  const double square = sum.value * sum.value;
  const mpq_class rest = exactly(sum.value) * exactly(sum.value) - exactly(square);
  RC_ASSERT(rest == exactly(exact::square_error(sum.value, square)));
}

}  // namespace
}  // namespace octocell
