// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/plan.hpp"

namespace octocell {

/// The spheres whose radius has one float exponent: within a factor of two of each other. Those of
/// radius 0 are a class of their own.
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
  bool some_may_collide = true;    // by their flags; false is certain
  float static_share = 0.0F;       // of the spheres, by their flags
  std::vector<RadiusClass> radii;  // the non-empty classes, smallest radius first
  std::vector<Sphere> sample;      // a sixteenth, 64 to kSampleSize, chosen by a fixed hash
  std::vector<Bulk> bulk;          // from the widest; empty unless a few centres are far away
};

inline constexpr std::size_t kSampleSize = 1024;

/// One pass over the spheres (two where radii differ).
/// Throws InputError naming the first sphere that is not finite or has a negative radius, or if
/// there are flags for some spheres only.
SceneStats measure(SceneView scene);

/// The last of those alone: one flag word a sphere, or none at all.
void require_all_flags(SceneView scene);

/// The facts alone, of a part of a scene: stage 1 of the host backends is this, in parallel.
/// A non-finite coordinate or a negative radius clears `valid`.
struct FactsPass {
  PlanFacts facts;
  bool valid = true;
};
FactsPass measure_facts(std::span<const Sphere> spheres);
/// The facts of two parts together.
FactsPass merge(const FactsPass& a, const FactsPass& b);

/// Does each of them lie on the lattice? Also for stage 1; as lies_on_lattice(), several at once.
bool lie_on_lattice(std::span<const Sphere> spheres, double units_per_length);

/// One line on what is wrong with the first invalid sphere; spheres must hold one.
std::string describe_first_invalid(std::span<const Sphere> spheres);

}  // namespace octocell
