// SPDX-License-Identifier: MIT
// What is right: the exact pair set, by two methods that share no code with the backends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "harness/interface/pair.hpp"
#include "harness/interface/sphere.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::reference {

/// |p - q|^2 <= (r_p + r_q)^2 over the reals, for finite spheres with r >= 0:
/// float64 where it is certain by a wide margin, else integers (GMP) in units of 2^-149.
bool overlap(const Sphere& a, const Sphere& b);

/// The same for float64 spheres, as a file may hold them before they are rounded.
bool overlap(const DoubleSphere& a, const DoubleSphere& b);

/// Do the flags let the two collide? Not both static, and each in a group of the other's mask.
bool allowed(Flags a, Flags b);

/// One flag word a sphere; none: every pair that overlaps is in the set.
using AllFlags = std::span<const Flags>;

/// Every pair tested: O(n^2). Sorted, i < j.
std::vector<Pair> brute_force(std::span<const Sphere> spheres, AllFlags flags = {});

/// A tree of float64 boxes, split at medians, joined with itself: for large scenes. Sorted, i < j.
std::vector<Pair> box_tree(std::span<const Sphere> spheres, AllFlags flags = {});
std::vector<Pair> box_tree(std::span<const DoubleSphere> spheres, AllFlags flags = {});

/// The exact pair set by the method that suits the size.
std::vector<Pair> exact_pairs(std::span<const Sphere> spheres, AllFlags flags = {});
inline std::vector<Pair> exact_pairs(const Scene& scene) {
  return exact_pairs(scene.spheres, scene.flags);
}

/// How an answer differs from the truth.
struct Comparison {
  std::uint64_t missed = 0;       // in the truth, not in the answer
  std::uint64_t false_pairs = 0;  // in the answer, not in the truth
  std::uint64_t duplicates = 0;   // reported again
  [[nodiscard]] bool only_missed() const { return false_pairs == 0 && duplicates == 0; }
  [[nodiscard]] bool exact() const { return missed == 0 && only_missed(); }
};

/// Both sorted; the truth without duplicates.
Comparison compare(std::span<const Pair> answer, std::span<const Pair> truth);

}  // namespace octocell::reference
