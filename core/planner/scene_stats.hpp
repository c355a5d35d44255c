// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/plan.hpp"

namespace octocell {

/// The spheres whose radii have the same float exponent, so they differ by less than a factor of
/// two. Spheres of radius 0 are a class of their own.
struct RadiusClass {
  std::uint64_t count = 0;
  double radius_sum = 0.0;
  float largest = 0.0F;
  [[nodiscard]] double mean_radius() const {
    return count == 0 ? 0.0 : radius_sum / static_cast<double>(count);
  }
};

/// A box that holds nearly all centres and is far smaller than the box of all.
struct Bulk {
  float lowest[3];
  float highest[3];
  friend bool operator==(const Bulk&, const Bulk&) = default;
};

/// What the planner knows of a scene.
struct SceneStats {
  PlanFacts facts;
  bool some_may_collide = true;    // by their flags; if false, it is certain
  float static_share = 0.0F;       // part of the spheres, by their flags
  std::vector<RadiusClass> radii;  // the non-empty classes, smallest radius first
  std::vector<Sphere> sample;  // a sixteenth of the spheres, 64 to kSampleSize, chosen by a fixed
                               // hash
  std::vector<Bulk> bulk;      // the widest first; empty unless a few centres are far away
};

inline constexpr std::size_t kSampleSize = 1024;

/// Measures a scene in one pass over the spheres (two if radii differ). Throws InputError naming
/// the first sphere that is not finite or has a negative radius, or if only some spheres have
/// flags.
SceneStats measure(SceneView scene);

/// Throws InputError unless there is one flag word for each sphere, or none at all.
void require_all_flags(SceneView scene);

/// Facts of a part of a scene: the host backends run this in parallel as stage 1. A non-finite
/// coordinate or a negative radius clears `valid`.
struct FactsPass {
  PlanFacts facts;
  bool valid = true;
};
FactsPass measure_facts(std::span<const Sphere> spheres);
/// Returns the facts of two parts together.
FactsPass merge(const FactsPass& a, const FactsPass& b);

/// Returns true if each sphere lies on the lattice, like lies_on_lattice(), but several at once.
/// Stage 1 uses it, too.
bool lie_on_lattice(std::span<const Sphere> spheres, double units_per_length);

/// Returns the position of the first invalid sphere; there must be one.
std::size_t first_invalid(std::span<const Sphere> spheres);

/// Returns one line on what is wrong with the first invalid sphere; there must be one.
std::string describe_first_invalid(std::span<const Sphere> spheres);

}  // namespace octocell
