// SPDX-License-Identifier: MIT
// How two records of a tile are tested. Records have no radius, so the first test takes the largest
// radius of the scene for both. If radii differ, the two spheres are then read and tested again.
#pragma once

#include "core/plan.hpp"
#include "impl_cuda_custom/device.cuh"
#include "impl_cuda_custom/pair_test.cuh"

namespace octocell::cuda_custom::tiles {

struct TileTest {
  PairTest test;      // one that may be exact
  bool equal_radii;   // then no sphere must be read
  float radius;       // the largest, as stored for the test
  float radius_sum2;  // of two spheres with that radius

  /// Returns true for every pair that overlaps (docs/exactness.md, "Tiles").
  [[nodiscard]] __device__ bool may_overlap(const TileRecord& a, const TileRecord& b) const {
    return !(distance2(sphere_of(a), sphere_of(b)) > radius_sum2);
  }

  /// Decides a pair that passed may_overlap().
  [[nodiscard]] __device__ Verdict verdict_on(const TileRecord& a, const TileRecord& b,
                                              const Sphere* spheres) const {
    if (equal_radii) return verdict_on(sphere_of(a), sphere_of(b));
    return verdict_on(stored(load_sphere(spheres, a.id)), stored(load_sphere(spheres, b.id)));
  }

 private:
  [[nodiscard]] __device__ Sphere sphere_of(const TileRecord& record) const {
    return {record.x, record.y, record.z, radius};
  }
  [[nodiscard]] __device__ Sphere stored(Sphere s) const {
    if (test == PairTest::filter_safe) s.r = filter_radius<Filter::safe>(s.r);
    if (test == PairTest::filter_fast || test == PairTest::filter_equal) {
      s.r = filter_radius<Filter::fast>(s.r);
    }
    return s;
  }
  [[nodiscard]] __device__ Verdict verdict_on(const Sphere& a, const Sphere& b) const {
    if (!filter_may_overlap(a, b)) return Verdict::apart;
    if (!has_uncertain_pairs(test)) return Verdict::overlap;
    const bool sure = test == PairTest::filter_safe ? filter_is_sure<Filter::safe>(a, b)
                                                    : filter_is_sure<Filter::fast>(a, b);
    return sure ? Verdict::overlap : Verdict::uncertain;
  }
};

inline TileTest tile_test(const Plan& plan) {
  const float radius = with_pair_test(
      plan.test, [&]<PairTest test>() { return octocell::stored_radius<test>(plan.facts.r_max); });
  return {plan.test, plan.tiles.equal_radii, radius, (radius + radius) * (radius + radius)};
}

}  // namespace octocell::cuda_custom::tiles
