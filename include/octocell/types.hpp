// SPDX-License-Identifier: MIT
// What goes in and what comes out: spheres, flags, pairs.
#pragma once

#include <compare>
#include <cstdint>

namespace octocell {

/// One sphere, in the scene's own unit of length. Valid if all four numbers are finite and r >= 0.
struct Sphere {
  float x;
  float y;
  float z;
  float r;
};
static_assert(sizeof(Sphere) == 16, "files and devices read spheres as rows of four floats");

/// Sphere ids share a word with four control bits, so ids have 28 bits.
inline constexpr std::uint64_t kMaxSpheres = std::uint64_t{1} << 28;

/// What a sphere may collide with, in one word (docs/decisions/0015-flags.md). Every word is valid.
///   bits  0-14  group: the groups that the sphere is in, one bit each
///   bit  15     static: two static spheres are no pair
///   bits 16-31  mask: the groups that it collides with; the highest bit is no group's
struct Flags {
  std::uint32_t word = 0xffff0001U;  // the default: not static, group 1, mask all
  friend constexpr bool operator==(Flags, Flags) = default;
};
static_assert(sizeof(Flags) == 4, "files and devices read flags as words");

inline constexpr std::uint32_t kMaxGroup = 0x7fff;
inline constexpr std::uint32_t kMaxMask = 0xffff;

constexpr Flags make_flags(bool is_static, std::uint32_t group, std::uint32_t mask) {
  return {mask << 16 | (is_static ? 0x8000U : 0U) | group};
}

/// Two overlapping spheres, i < j. Ids are positions in the scene, from 0.
struct Pair {
  std::uint32_t i;
  std::uint32_t j;
  friend constexpr auto operator<=>(const Pair&, const Pair&) = default;
};
static_assert(sizeof(Pair) == 8, "files and devices read pairs as rows of two words");

}  // namespace octocell
