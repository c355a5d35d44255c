// SPDX-License-Identifier: MIT
// Sorted ids of columns, read a vector at a time.
#pragma once

#include <cstdint>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/lanes.hpp"

namespace octocell::cpu::half_shell {

inline constexpr std::uint32_t kLanes = block_size(kMostLanes, kMostLanes / 2);
using Ids = Vector<std::uint32_t, kLanes>;

/// Returns the first place from `at` on whose id is above `id`. `ids` must be sorted and followed
/// by kPassed values above all ids. Compares kPassed ids at a time, because most steps are shorter.
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

}  // namespace octocell::cpu::half_shell
