// SPDX-License-Identifier: MIT
// How kernels test two spheres. The kernels of half_shell have the test compiled in, for speed; the
// others select it at run time.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/precision.hpp"
#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {

/// Computes filter_may_overlap() with fused operations; its proof allows that.
__device__ inline float distance2(const Sphere& a, const Sphere& b) {
  const float dx = a.x - b.x;
  const float dy = a.y - b.y;
  const float dz = a.z - b.z;
  return __fmaf_rn(dz, dz, __fmaf_rn(dy, dy, dx * dx));
}
__device__ inline bool within_f32(const Sphere& a, const Sphere& b) {
  const float radius_sum = a.r + b.r;
  return !(distance2(a, b) > radius_sum * radius_sum);
}
__device__ inline bool within_f64(const Sphere& a, const Sphere& b) {
  const double dx = static_cast<double>(a.x) - static_cast<double>(b.x);
  const double dy = static_cast<double>(a.y) - static_cast<double>(b.y);
  const double dz = static_cast<double>(a.z) - static_cast<double>(b.z);
  const double radius_sum = static_cast<double>(a.r) + static_cast<double>(b.r);
  return __fma_rn(dz, dz, __fma_rn(dy, dy, dx * dx)) <= radius_sum * radius_sum;
}

/// The type of sphere that a test reads.
template <PairTest test>
using Read = std::conditional_t<is_packed(test), PackedSphere, Sphere>;

__device__ inline Sphere load(const Sphere* spheres, std::uint64_t i) {
  return load_sphere(spheres, i);
}
/// Loads eight bytes at once.
__device__ inline PackedSphere load(const PackedSphere* spheres, std::uint64_t i) {
  const ushort4 s = __ldg(reinterpret_cast<const ushort4*>(spheres) + i);
  return {s.x, s.y, s.z, s.w};
}

/// A test that is known when the kernel is compiled.
template <PairTest test>
struct FixedTest {
  Packing packing;

  [[nodiscard]] __device__ bool may_overlap(const Read<test>& a, const Read<test>& b) const {
    if constexpr (test == PairTest::f16) {
      return f16::may_overlap(a, b);
    } else if constexpr (test == PairTest::q16) {
      return q16::may_overlap(a, b);
    } else if constexpr (test == PairTest::q16_exact) {
      return q16::may_overlap_exactly(a, b);
    } else if constexpr (test == PairTest::f64) {
      return within_f64(a, b);
    } else if constexpr (test == PairTest::f32_sqrt || test == PairTest::boxes ||
                         test == PairTest::gram) {
      return octocell::may_overlap<test>(a, b);
    } else {
      return within_f32(a, b);
    }
  }
  [[nodiscard]] __device__ Verdict verdict_on(const Sphere& a, const Sphere& b) const {
    return octocell::verdict_on<test>(a, b, packing);
  }
};

/// A test that is known when the kernel runs, the same for all threads. Packed tests pack each
/// time.
struct AnyTest {
  PairTest test;
  Packing packing;

  [[nodiscard]] __device__ bool may_overlap(const Sphere& a, const Sphere& b) const {
    if (has_filter()) return within_f32(a, b);
    return with_pair_test(test, [&]<PairTest fixed>() {
      if constexpr (is_packed(fixed)) {
        return FixedTest<fixed>{packing}.may_overlap(pack<fixed>(a, packing),
                                                     pack<fixed>(b, packing));
      } else {
        return FixedTest<fixed>{packing}.may_overlap(a, b);
      }
    });
  }
  [[nodiscard]] __device__ Verdict verdict_on(const Sphere& a, const Sphere& b) const {
    return with_pair_test(
        test, [&]<PairTest fixed>() { return octocell::verdict_on<fixed>(a, b, packing); });
  }

 private:
  [[nodiscard]] __device__ bool has_filter() const { return test <= PairTest::filter_equal; }
};

/// Returns the radius that stage 5 uses; called once per sphere.
__device__ inline float stored_radius(PairTest test, float r) {
  return with_pair_test(test, [r]<PairTest fixed>() { return octocell::stored_radius<fixed>(r); });
}

__device__ inline PackedSphere pack(PairTest test, const Sphere& s, const Packing& packing) {
  if (test == PairTest::f16) return octocell::pack<PairTest::f16>(s, packing);
  if (test == PairTest::q16) return octocell::pack<PairTest::q16>(s, packing);
  return octocell::pack<PairTest::q16_exact>(s, packing);
}

}  // namespace octocell::cuda_custom
