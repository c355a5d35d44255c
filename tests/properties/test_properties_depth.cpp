// SPDX-License-Identifier: MIT
// Depths of any two finite spheres. The check takes no square root: it squares both sides.
#include <gtest/gtest.h>

// needs the above
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/depth.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/properties/generators.hpp"
#include "tests/properties/oracle.hpp"

namespace octocell {
namespace {

using properties::any_pair;
using properties::exactly;
using properties::Two;

/// Is s - |p - q| < bound?  That is, |p - q| > s - bound.
bool depth_below(const Two& two, const mpq_class& bound) {
  const mpq_class dx = exactly(two.a.x) - exactly(two.b.x);
  const mpq_class dy = exactly(two.a.y) - exactly(two.b.y);
  const mpq_class dz = exactly(two.a.z) - exactly(two.b.z);
  const mpq_class rest = exactly(two.a.r) + exactly(two.b.r) - bound;
  return rest < 0 || dx * dx + dy * dy + dz * dz > rest * rest;
}
/// Is it > bound?
bool depth_above(const Two& two, const mpq_class& bound) {
  const mpq_class dx = exactly(two.a.x) - exactly(two.b.x);
  const mpq_class dy = exactly(two.a.y) - exactly(two.b.y);
  const mpq_class dz = exactly(two.a.z) - exactly(two.b.z);
  const mpq_class rest = exactly(two.a.r) + exactly(two.b.r) - bound;
  return rest > 0 && dx * dx + dy * dy + dz * dz < rest * rest;
}

/// Is the real depth at most so many units away? The units are those to the next float32 on
/// either side; below a power of two they are half as large.
bool is_within(const Two& two, float depth, const mpq_class& ulps) {
  const mpq_class here = exactly(depth);
  const mpq_class down = here - exactly(std::nextafter(depth, -kFloatMax));
  const mpq_class up = exactly(std::nextafter(depth, kFloatMax)) - here;
  return !depth_below(two, here - ulps * down) && !depth_above(two, here + ulps * up);
}

bool is_ordinary(float depth) { return std::isfinite(depth) && std::fabs(depth) < kFloatMax; }

RC_GTEST_PROP(DepthProperties, ErrorIsAtMostWhatIsProved, ()) {
  const Two two = *any_pair();
  const float depth = penetration_depth(two.a, two.b);
  if (!is_ordinary(depth)) RC_DISCARD("beyond float32");
  RC_ASSERT(is_within(two, depth, mpq_class(5000025, 10000000)));
}

RC_GTEST_PROP(DepthProperties, TheReferenceIsCorrectlyRounded, ()) {
  const Two two = *any_pair();
  const float depth = reference::depth(two.a, two.b);
  if (!is_ordinary(depth)) RC_DISCARD("beyond float32");
  RC_ASSERT(is_within(two, depth, mpq_class(1, 2)));
  RC_ASSERT(reference::depth_error_ulp(depth, two.a, two.b) <= 0.5);
}

RC_GTEST_PROP(DepthProperties, SignTellsWhoOverlaps, ()) {
  const Two two = *any_pair();
  const bool truth = properties::overlap(two.a, two.b);
  const float depth = penetration_depth(two.a, two.b);
  RC_ASSERT((truth ? depth >= 0.0F : depth <= 0.0F));
  RC_ASSERT(truth == (reference::relative_depth(two.a, two.b) >= 0.0));
}

RC_GTEST_PROP(DepthProperties, OrderOfTheTwoDoesNotMatter, ()) {
  const Two two = *any_pair();
  RC_ASSERT(penetration_depth(two.a, two.b) == penetration_depth(two.b, two.a));
}

}  // namespace
}  // namespace octocell
