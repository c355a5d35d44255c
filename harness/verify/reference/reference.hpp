// SPDX-License-Identifier: MIT
// The truth: the exact pair set, by two methods that share no code with the backends.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/pair.hpp"
#include "core/sphere.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell::reference {

/// Throws LimitError in a build without a reference; all functions below need one.
void require_available();

/// Returns whether |p - q|^2 <= (r_p + r_q)^2 over the reals, for finite spheres with r >= 0. Uses
/// float64 if that is certain by a wide margin; otherwise integers (GMP) in units of 2^-149.
bool overlap(const Sphere& a, const Sphere& b);

/// Does the same for float64 spheres, as a file may hold them before rounding.
bool overlap(const DoubleSphere& a, const DoubleSphere& b);

/// Returns whether the flags let the two collide: not both are static, and each is in a group of
/// the other's mask.
bool allowed(Flags a, Flags b);

/// One flag word a sphere; if empty, every pair that overlaps counts.
using AllFlags = std::span<const Flags>;

/// Tests every pair: O(n^2). Sorted, i < j.
std::vector<Pair> brute_force(std::span<const Sphere> spheres, AllFlags flags = {});

/// Joins a tree of float64 boxes, split at medians, with itself; for large scenes. Sorted, i < j.
std::vector<Pair> box_tree(std::span<const Sphere> spheres, AllFlags flags = {});
std::vector<Pair> box_tree(std::span<const DoubleSphere> spheres, AllFlags flags = {});

/// Returns the exact pair set, by the method that suits the size.
std::vector<Pair> exact_pairs(std::span<const Sphere> spheres, AllFlags flags = {});
inline std::vector<Pair> exact_pairs(const Scene& scene) {
  return exact_pairs(scene.spheres, scene.flags);
}

/// Returns r_p + r_q - |p - q|, rounded correctly to float32 (to nearest, ties to even). For finite
/// spheres with r >= 0; negative if they are apart.
float depth(const Sphere& a, const Sphere& b);

/// Returns how far `claimed` is from the depth over the reals, in units in the last place of a
/// float32 of that size. It is at most 0.5 if `claimed` was rounded correctly. Beyond the range of
/// float32, infinity is right (0).
double depth_error_ulp(float claimed, const Sphere& a, const Sphere& b);

/// Returns the depth over the reals divided by r_p + r_q, to 1e-15 of its value even near contact.
/// For two points (r = 0) that are apart, returns the lowest float64.
double relative_depth(const Sphere& a, const Sphere& b);

/// Errors of the depths of many pairs; zeros if there are none. Quantiles are values that occur.
struct DepthErrors {
  double median_ulp = 0.0;
  double p99_ulp = 0.0;
  double max_ulp = 0.0;
  std::uint64_t not_nearest = 0;  // depths that are not rounded correctly
};
DepthErrors depth_errors(std::span<const float> depths, std::span<const Pair> pairs,
                         std::span<const Sphere> spheres);

/// How an answer differs from the truth.
struct Comparison {
  std::uint64_t missed = 0;       // in the truth, not in the answer
  std::uint64_t false_pairs = 0;  // in the answer, not in the truth
  std::uint64_t duplicates = 0;   // pairs reported more than once
  /// How deep the deepest missed pair overlaps (0 if it only touches), and how far the farthest
  /// false pair is apart, as parts of r_p + r_q. None if there is no such pair, or if no spheres
  /// were given.
  std::optional<double> worst_missed_depth = {};
  std::optional<double> worst_false_gap = {};
  /// The first pair of each kind, in the order of pairs.
  std::optional<Pair> first_missed = {};
  std::optional<Pair> first_false = {};
  std::optional<Pair> first_duplicate = {};
  [[nodiscard]] bool only_missed() const { return false_pairs == 0 && duplicates == 0; }
  [[nodiscard]] bool exact() const { return missed == 0 && only_missed(); }
};

/// Compares two sorted lists of pairs; the truth has no duplicates. `spheres` are those of the
/// scene.
Comparison compare(std::span<const Pair> answer, std::span<const Pair> truth,
                   std::span<const Sphere> spheres = {});

/// How rounding a scene to float32 changed the exact pair set.
struct RoundingEffect {
  std::uint64_t lost = 0;
  std::uint64_t gained = 0;
};
RoundingEffect rounding_effect(std::span<const DoubleSphere> unrounded, AllFlags flags,
                               std::span<const Pair> pairs_of_rounded);

}  // namespace octocell::reference
