// SPDX-License-Identifier: MIT
// Plans of half_shell that the planner would not choose, and scenes that make their axes wrap.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "tests/support/ask_finder.hpp"

namespace octocell {

/// How spheres are cut into levels, and cells into columns.
struct Cut {
  std::size_t levels;
  std::uint32_t columns;
  double diameters;  // the side of a cell
  int most_bits;     // of a level's ids; if there are few, axes wrap
};

/// Makes a plan with the same number of spheres in each level, unless radii are equal.
inline Plan with_levels(Plan plan, const Scene& scene, const Cut& cut) {
  std::vector<float> radii;
  for (const Sphere& s : scene.spheres) radii.push_back(s.r);
  std::sort(radii.begin(), radii.end());
  plan.levels = {};
  std::uint32_t first_id = 0;
  for (std::size_t k = 1; k <= cut.levels; ++k) {
    const float r_max = radii[radii.size() * k / cut.levels - 1];
    Level& level = plan.levels.level[plan.levels.count++];
    level = make_level(plan.facts, r_max, cut.diameters * 2.0 * r_max, cut.columns, cut.most_bits);
    level.first_id = first_id;
    first_id += level.ids;
  }
  plan.key_bits = key_bits_of(plan.levels);
  return plan;
}

/// Makes two gases so far apart on all axes that no number of bits counts the cells between them.
inline Scene far_apart(const char* spec, float offset) {
  Scene scene = generate(spec);
  for (std::size_t i = 0; i < scene.spheres.size(); i += 3) {
    Sphere& s = scene.spheres[i];
    s = {s.x + offset, s.y - offset, s.z + offset, s.r};
  }
  return scene;
}

}  // namespace octocell
