// SPDX-License-Identifier: MIT
// Eight spheres side by side, and level 1 of the predicate for one sphere against all of them.
#pragma once

#include <bit>
#include <experimental/simd>

#include "harness/interface/faults.hpp"
#include "harness/interface/sphere.hpp"

namespace octocell::cpu::half_shell {

namespace stdx = std::experimental;

inline constexpr std::uint32_t kLanes = 16;
using Floats = stdx::simd<float, stdx::simd_abi::deduce_t<float, kLanes>>;
using LaneMask = Floats::mask_type;

struct Lanes {
  Floats x, y, z, r;

  /// Reads eight from each field on, however few there are.
  Lanes(const float* xs, const float* ys, const float* zs, const float* rs)
      : x(xs, stdx::element_aligned),
        y(ys, stdx::element_aligned),
        z(zs, stdx::element_aligned),
        r(rs, stdx::element_aligned) {}

  /// As band_may_overlap(), for all lanes. Radii are band radii.
  [[nodiscard]] LaneMask may_overlap(float px, float py, float pz, float pr) const {
    const Floats dx = x - px;
    const Floats dy = y - py;
    const Floats dz = z - pz;
    const Floats reach = r + pr;
    return dx * dx + dy * dy + dz * dz <= reach * reach;
  }
};

/// One bit a lane, the first lowest.
using LaneBits = std::uint16_t;
template <typename Mask>
LaneBits bits_of(const Mask& mask) {
  return static_cast<LaneBits>(mask.__to_bitset().to_ulong());  // libstdc++'s, for want of a better
}
inline LaneBits first_bits(std::uint32_t count) {
  return static_cast<LaneBits>(count >= kLanes
                                   ? OCTOCELL_FAULT(shell_last_lane_missing, 0x7fffU, 0xffffU)
                                   : (1U << count) - 1U);
}

using Ids = stdx::simd<std::uint32_t, stdx::simd_abi::deduce_t<std::uint32_t, 16>>;

/// The first place from `at` on whose id is above `id`; `ids` are sorted, and behind the last come
/// kPassed that are above all. So many at a time: a step is as a rule shorter.
inline constexpr std::uint32_t kPassed = 2 * Ids::size();
inline std::uint32_t first_above(const std::uint32_t* ids, std::uint32_t at, std::uint32_t id) {
  for (;;) {
    const Ids here(ids + at, stdx::element_aligned);
    const Ids next(ids + at + Ids::size(), stdx::element_aligned);
    const auto passed =
        static_cast<std::uint32_t>(stdx::popcount(here <= id) + stdx::popcount(next <= id));
    at += passed;
    if (passed < kPassed) return at;
  }
}

/// Calls visit(lane) for each lane that is set.
template <typename Visit>
void for_each_lane(std::uint32_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

}  // namespace octocell::cpu::half_shell
