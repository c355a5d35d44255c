// SPDX-License-Identifier: MIT
// How two spheres touch, and which test of two spheres would take them for what they are not.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "harness/judge/hypotheses.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::judge {
namespace {

struct Float32Test {
  float distance2;
  float radius_sum2;
};

Float32Test float32_test(const Sphere& a, const Sphere& b) {
  const float x = a.x - b.x;
  const float y = a.y - b.y;
  const float z = a.z - b.z;
  const float r = a.r + b.r;
  return {x * x + y * y + z * z, r * r};
}

/// Returns (r + r' - distance) / (r + r'), roughly.
double rough_depth(const Sphere& a, const Sphere& b) {
  const double x = static_cast<double>(a.x) - b.x;
  const double y = static_cast<double>(a.y) - b.y;
  const double z = static_cast<double>(a.z) - b.z;
  const double r = static_cast<double>(a.r) + b.r;
  return r > 0.0 ? 1.0 - std::sqrt(x * x + y * y + z * z) / r : 0.0;
}

bool nearly_touch(const Sphere& a, const Sphere& b) { return std::abs(rough_depth(a, b)) < 1e-6; }

bool touch_exactly(const Sphere& a, const Sphere& b) {
  return nearly_touch(a, b) && reference::relative_depth(a, b) == 0.0;
}

bool boxes_overlap(const Sphere& a, const Sphere& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double distance = static_cast<double>(centre_of(a)[axis]) - centre_of(b)[axis];
    if (std::abs(distance) > static_cast<double>(a.r) + b.r) return false;
  }
  return true;
}

bool overlap_without(std::size_t axis, const Sphere& a, const Sphere& b) {
  double distance2 = 0.0;
  for (std::size_t other = 0; other < 3; ++other) {
    const double d = static_cast<double>(centre_of(a)[other]) - centre_of(b)[other];
    if (other != axis) distance2 += d * d;
  }
  const double r = static_cast<double>(a.r) + b.r;
  return distance2 <= r * r;
}

double distance_of(const Sphere& a, const Sphere& b) {
  return std::hypot(static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y,
                    static_cast<double>(a.z) - b.z);
}

Hypothesis of_spheres(std::string name, std::string text, const SceneFacts& facts,
                      std::function<bool(const Sphere&, const Sphere&)> holds) {
  return {.name = std::move(name),
          .text = std::move(text),
          .holds = [&facts, holds = std::move(holds)](Pair pair) {
            return holds(facts.spheres[pair.i], facts.spheres[pair.j]);
          }};
}

}  // namespace

void add_contact(Hypotheses& all, const SceneFacts& facts) {
  all.push_back(of_spheres("touching",
                           "touch exactly: the distance is the sum of the radii, and < was taken "
                           "for <=",
                           facts, touch_exactly));
  all.push_back(of_spheres("float32 test",
                           "are apart by a test in float32, which rounds: they nearly touch", facts,
                           [](const Sphere& a, const Sphere& b) {
                             const Float32Test test = float32_test(a, b);
                             return test.distance2 > test.radius_sum2;
                           }));
  all.push_back(of_spheres("float32 test",
                           "are not nearer than the sum of the radii by a test in float32 with <",
                           facts, [](const Sphere& a, const Sphere& b) {
                             const Float32Test test = float32_test(a, b);
                             return test.distance2 >= test.radius_sum2;
                           }));
  all.push_back(of_spheres("nearly touching", "touch to within 1e-6 of the sum of the radii", facts,
                           nearly_touch));
  all.back().spoils_some = true;
}

void add_false_tests(Hypotheses& all, const SceneFacts& facts) {
  all.push_back(
      of_spheres("flags ignored", "overlap, but by their flags they do not collide", facts,
                 [](const Sphere& a, const Sphere& b) { return reference::overlap(a, b); }));
  all.push_back(of_spheres("float32 test",
                           "overlap by a test in float32, which rounds: they nearly touch", facts,
                           [](const Sphere& a, const Sphere& b) {
                             const Float32Test test = float32_test(a, b);
                             return test.distance2 <= test.radius_sum2;
                           }));
  all.push_back(of_spheres("nearly touching", "are apart by less than 1e-6 of the sum of the radii",
                           facts, nearly_touch));
  all.back().spoils_some = true;
  all.push_back(of_spheres("boxes only", "have boxes that overlap: the balls were not tested",
                           facts, boxes_overlap));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.push_back(of_spheres(
        "axis ignored", fmt::format("would overlap without {}", "xyz"[axis]), facts,
        [axis](const Sphere& a, const Sphere& b) { return overlap_without(axis, a, b); }));
  }
  all.push_back(of_spheres("largest radius",
                           "are nearer than twice the largest radius, as if all had it", facts,
                           [most = 2.0 * facts.r_max](const Sphere& a, const Sphere& b) {
                             return distance_of(a, b) <= most;
                           }));
}

}  // namespace octocell::judge
