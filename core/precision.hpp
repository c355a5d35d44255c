// SPDX-License-Identifier: MIT
// How stage 5 tests two spheres. This is the only place where a precision mode is chosen.
//
// A test has two steps. may_overlap() runs on every candidate, so it decides how much a candidate
// costs. verdict_on() runs on the few that pass; it returns overlap, apart, or uncertain (left to
// stage 6). The user chooses a predicate; the plan turns it into the test that the scene needs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/overlap.hpp"
#include "core/packed_sphere.hpp"

namespace octocell {

/// What the user chooses. Only `exact` and `q16_exact` promise the exact pairs; the others show
/// what giving up exactness gains, and what it costs.
enum class Predicate : std::uint8_t {
  exact,      // float32 with a proved filter; uncertain pairs are decided over the reals
  f32,        // |p - q|^2 <= (r_p + r_q)^2, all in float32
  f32_sqrt,   // |p - q| <= r_p + r_q, all in float32
  f64,        // float32 spheres, all in float64
  aabb_only,  // boxes [p - r, p + r]: loses no pair, but reports boxes that overlap only at corners
  f16_cell,   // positions and radii as 16-bit floats, relative to a cell
  q16_cell,   // positions and radii as 16-bit integers, relative to a cell
  q16_exact,  // the same, rounded so that no pair is lost; candidates that pass are tested exactly
  gram_f32,  // |p|^2 + |q|^2 - 2 p.q, all in float32, as hardware for matrix products would compute
             // it
};
inline constexpr std::array<std::string_view, 9> kPredicateNames = {
    "exact",    "f32",      "f32_sqrt",  "f64",     "aabb_only",
    "f16_cell", "q16_cell", "q16_exact", "gram_f32"};
constexpr std::string_view name_of(Predicate p) {
  return kPredicateNames[static_cast<std::size_t>(p)];
}
constexpr bool claims_exact(Predicate p) {
  return p == Predicate::exact || p == Predicate::q16_exact;
}

enum class PairTest : std::uint8_t {
  filter_fast,   // for predicate exact: radii in the range of Filter::fast
  filter_safe,   // for predicate exact: any radii
  filter_equal,  // like filter_fast, but all radii are equal, so the right-hand side is a constant
  f32,           // for predicate f32; for exact, if a lattice makes float32 exact
  f32_sqrt,
  f64,
  boxes,
  f16,
  q16,
  q16_exact,
  gram,
};

/// Returns true if the test stores spheres with 16 bits a number.
OCTOCELL_HD constexpr bool is_packed(PairTest t) {
  return t == PairTest::f16 || t == PairTest::q16 || t == PairTest::q16_exact;
}

/// Returns true if the test compares with one constant, so that it needs only one sphere's radius.
OCTOCELL_HD constexpr bool has_one_radius(PairTest t) { return t == PairTest::filter_equal; }

/// Returns the filter of a test that has one.
OCTOCELL_HD constexpr Filter filter_of(PairTest t) {
  return t == PairTest::filter_safe ? Filter::safe : Filter::fast;
}

/// Returns true if the test may leave uncertain pairs; otherwise stage 6 has nothing to do.
OCTOCELL_HD constexpr bool has_uncertain_pairs(PairTest t) {
  return t <= PairTest::filter_equal || t == PairTest::q16_exact;
}

/// Returns true for the tests that serve predicate exact. Only these are recorded.
OCTOCELL_HD constexpr bool may_be_exact(PairTest t) { return t <= PairTest::f32; }

/// Returns the radius as stage 5 stores it in a float; called once per sphere. Packed tests store
/// floats, too, for candidates that pass.
template <PairTest test>
OCTOCELL_HD float stored_radius(float r) {
  if constexpr (test == PairTest::filter_fast || test == PairTest::filter_equal) {
    return filter_radius<Filter::fast>(r);
  } else if constexpr (test == PairTest::filter_safe || test == PairTest::q16_exact) {
    return filter_radius<Filter::safe>(r);
  } else {
    return r;
  }
}

/// Returns the sphere as stage 5 stores it in floats.
template <PairTest test>
OCTOCELL_HD Sphere stored(const Sphere& s) {
  return {s.x, s.y, s.z, stored_radius<test>(s.r)};
}

/// Returns the sphere as a packed test stores it.
template <PairTest test>
OCTOCELL_HD PackedSphere pack(const Sphere& s, const Packing& packing) {
  if constexpr (test == PairTest::f16) {
    return {f16::place(s.x, packing), f16::place(s.y, packing), f16::place(s.z, packing),
            f16::radius(s.r, packing)};
  }
  const std::uint16_t r = test == PairTest::q16_exact ? q16::upper_radius(s.r, packing)
                                                      : q16::nearest_radius(s.r, packing);
  return {q16::place(s.x, packing), q16::place(s.y, packing), q16::place(s.z, packing), r};
}

/// Tests of two spheres with stored radii.
namespace pair_tests {

OCTOCELL_HD bool within_f32_sqrt(const Sphere& a, const Sphere& b) {
  return sqrtf(filter_distance2(a, b)) <= a.r + b.r;
}

OCTOCELL_HD bool within_f64(const Sphere& a, const Sphere& b) {
  const double dx = static_cast<double>(a.x) - static_cast<double>(b.x);
  const double dy = static_cast<double>(a.y) - static_cast<double>(b.y);
  const double dz = static_cast<double>(a.z) - static_cast<double>(b.z);
  const double radius_sum = static_cast<double>(a.r) + static_cast<double>(b.r);
  return dx * dx + dy * dy + dz * dz <= radius_sum * radius_sum;
}

/// Each end is rounded once, and rounding is monotone. So if two spheres overlap, their boxes do,
/// too.
OCTOCELL_HD bool boxes_meet(const Sphere& a, const Sphere& b) {
  return a.x - a.r <= b.x + b.r && b.x - b.r <= a.x + a.r &&  //
         a.y - a.r <= b.y + b.r && b.y - b.r <= a.y + a.r &&  //
         a.z - a.r <= b.z + b.r && b.z - b.r <= a.z + a.r;
}

OCTOCELL_HD float norm2(const Sphere& s) { return s.x * s.x + s.y * s.y + s.z * s.z; }

OCTOCELL_HD bool within_gram(const Sphere& a, const Sphere& b) {
  const float product = a.x * b.x + a.y * b.y + a.z * b.z;
  const float radius_sum = a.r + b.r;
  return norm2(a) + norm2(b) - 2.0F * product <= radius_sum * radius_sum;
}

}  // namespace pair_tests

/// Returns true for every pair that the test takes for an overlap. For tests that are not packed.
template <PairTest test>
OCTOCELL_HD bool may_overlap(const Sphere& a, const Sphere& b) {
  static_assert(!is_packed(test), "packed spheres have may_overlap() of their own");
  if constexpr (test == PairTest::f32_sqrt) return pair_tests::within_f32_sqrt(a, b);
  if constexpr (test == PairTest::f64) return pair_tests::within_f64(a, b);
  if constexpr (test == PairTest::boxes) return pair_tests::boxes_meet(a, b);
  if constexpr (test == PairTest::gram) return pair_tests::within_gram(a, b);
  return filter_may_overlap(a, b);  // includes f32, whose stored radii are not enlarged
}

/// Decides a pair that passed may_overlap(). `packing` belongs to a packed test.
template <PairTest test>
OCTOCELL_HD Verdict verdict_on(const Sphere& a, const Sphere& b, const Packing& packing) {
  if constexpr (test == PairTest::f16 || test == PairTest::q16) {
    // Packed cells repeat in space: spheres that are far apart may have looked near.
    return are_near(a, b, packing) ? Verdict::overlap : Verdict::apart;
  }
  if constexpr (test == PairTest::q16_exact) {
    if (!filter_may_overlap(a, b)) return Verdict::apart;
    return filter_is_sure<Filter::safe>(a, b) ? Verdict::overlap : Verdict::uncertain;
  }
  if constexpr (!has_uncertain_pairs(test)) return Verdict::overlap;
  constexpr Filter filter = test == PairTest::filter_safe ? Filter::safe : Filter::fast;
  return filter_is_sure<filter>(a, b) ? Verdict::overlap : Verdict::uncertain;
}

#ifdef __CUDACC__  // `run` may be a function of the host or of the device, like its caller
#define OCTOCELL_CALLS_EITHER _Pragma("nv_exec_check_disable")
#else
#define OCTOCELL_CALLS_EITHER
#endif

/// Calls run.operator()<test>() for the plan's test.
OCTOCELL_CALLS_EITHER
template <typename Run>
OCTOCELL_HD decltype(auto) with_pair_test(PairTest test, Run&& run) {
  switch (test) {
    case PairTest::filter_fast:
      return run.template operator()<PairTest::filter_fast>();
    case PairTest::filter_safe:
      return run.template operator()<PairTest::filter_safe>();
    case PairTest::filter_equal:
      return run.template operator()<PairTest::filter_equal>();
    case PairTest::f32:
      return run.template operator()<PairTest::f32>();
    case PairTest::f32_sqrt:
      return run.template operator()<PairTest::f32_sqrt>();
    case PairTest::f64:
      return run.template operator()<PairTest::f64>();
    case PairTest::boxes:
      return run.template operator()<PairTest::boxes>();
    case PairTest::f16:
      return run.template operator()<PairTest::f16>();
    case PairTest::q16:
      return run.template operator()<PairTest::q16>();
    case PairTest::q16_exact:
      return run.template operator()<PairTest::q16_exact>();
    case PairTest::gram:
      break;
  }
  return run.template operator()<PairTest::gram>();
}

/// Does the same if only tests with a filter can occur.
template <typename Run>
decltype(auto) with_filter_test(PairTest test, Run&& run) {
  if (test == PairTest::filter_fast) return run.template operator()<PairTest::filter_fast>();
  if (test == PairTest::filter_equal) return run.template operator()<PairTest::filter_equal>();
  return run.template operator()<PairTest::filter_safe>();
}

}  // namespace octocell
