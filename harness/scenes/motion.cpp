// SPDX-License-Identifier: MIT
#include "harness/scenes/motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <span>
#include <system_error>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "core/flags.hpp"
#include "harness/scenes/portable_math.hpp"

namespace octocell {
namespace {

constexpr double kStep = 0.0577;  // part of the radius: at most 0.1 radii in three dimensions
constexpr double kSlowStep = kStep / 10.0;
constexpr double kFewMove = 0.1;        // part of all spheres
constexpr double kDarts = 0.01;         // part of all spheres
constexpr double kDartStep = 2.0;       // part of the radius
constexpr double kAcceleration = 0.02;  // part of the largest radius, per frame and frame
constexpr double kRestitution = 0.5;

struct Body {
  double position[3];
  double velocity[3];
};

struct World {
  std::vector<Body> bodies;
  double lowest[3];
  double highest[3];
  double r_max = 0.0;
};

World world_of(const std::vector<Sphere>& start) {
  World world;
  std::fill_n(world.lowest, 3, std::numeric_limits<double>::infinity());
  std::fill_n(world.highest, 3, -std::numeric_limits<double>::infinity());
  for (const Sphere& s : start) {
    world.bodies.push_back({{s.x, s.y, s.z}, {0, 0, 0}});
    world.r_max = std::max<double>(world.r_max, s.r);
    for (int a = 0; a < 3; ++a) {
      world.lowest[a] = std::min(world.lowest[a], world.bodies.back().position[a]);
      world.highest[a] = std::max(world.highest[a], world.bodies.back().position[a]);
    }
  }
  return world;
}

/// Reflects once, which is enough for steps shorter than the box; in a thinner box, clamps.
double reflect(double value, double low, double high) {
  if (value < low) value = low + (low - value);
  if (value > high) value = high - (value - high);
  return std::clamp(value, low, high);
}

/// Moves a sphere by at most `longest` along each axis, in radii.
void jostle(World& world, std::size_t i, double longest, float radius, Random& random) {
  for (int a = 0; a < 3; ++a) {
    const double step = (2.0 * random.uniform() - 1.0) * longest * radius;
    double& p = world.bodies[i].position[a];
    p = reflect(p + step, world.lowest[a], world.highest[a]);
  }
}

void step_brownian(World& world, const std::vector<Sphere>& radii, double step, Random& random) {
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    jostle(world, i, step, radii[i].r, random);
  }
}

/// Moves a share of the spheres. Draws them from the same seed in every frame, so they stay the
/// same.
void step_some(World& world, const std::vector<Sphere>& radii, double share, double longest,
               std::uint64_t seed, Random& random) {
  Random draw(~seed);
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    if (draw.uniform() < share) jostle(world, i, longest, radii[i].r, random);
  }
}

void step_free_fall(World& world) {
  for (Body& body : world.bodies) {
    double& z = body.position[2];
    double& speed = body.velocity[2];
    speed -= kAcceleration * world.r_max;
    z += speed;
    if (z >= world.lowest[2]) continue;
    z = world.lowest[2] + (world.lowest[2] - z) * kRestitution;
    speed = -speed * kRestitution;
  }
}

void step_gravity(World& world) {
  for (Body& body : world.bodies) {
    double pull[3];
    double length2 = 0.0;
    for (int a = 0; a < 3; ++a) {
      pull[a] = (world.lowest[a] + world.highest[a]) / 2.0 - body.position[a];
      length2 += pull[a] * pull[a];
    }
    const double length = std::sqrt(length2);
    for (int a = 0; a < 3; ++a) {
      if (length > 0.0) body.velocity[a] += kAcceleration * world.r_max * pull[a] / length;
      body.position[a] += body.velocity[a];
    }
  }
}

/// Returns the spheres of a frame. The bodies of static spheres move, too, but this is not shown:
/// so other spheres draw the same random numbers with and without flags.
std::vector<Sphere> snapshot(const World& world, const std::vector<Sphere>& start,
                             std::span<const Flags> flags) {
  std::vector<Sphere> spheres;
  spheres.reserve(start.size());
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (!flags.empty() && is_static(flags[i])) {
      spheres.push_back(start[i]);
      continue;
    }
    const double* p = world.bodies[i].position;
    spheres.push_back(
        {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), start[i].r});
  }
  return spheres;
}

}  // namespace

Motion motion_named(std::string_view name) {
  const auto found = std::ranges::find(kMotionNames, name);
  if (found != kMotionNames.end()) return static_cast<Motion>(found - kMotionNames.begin());
  throw InputError(
      fmt::format("unknown motion '{}'; known: {}", name, fmt::join(kMotionNames, ", ")));
}

Frames move(const std::vector<Sphere>& start, Motion motion, int count, std::uint64_t seed,
            std::span<const Flags> flags) {
  const double bytes = static_cast<double>(count) * sizeof(Sphere) + sizeof(Body);
  require_memory(static_cast<double>(start.size()) * bytes, fmt::format("{} frames", count));
  World world = world_of(start);
  Random random(seed);
  Frames frames = {start};
  while (static_cast<int>(frames.size()) < count) {
    switch (motion) {
      case Motion::brownian:
        step_brownian(world, start, kStep, random);
        break;
      case Motion::free_fall:
        step_free_fall(world);
        break;
      case Motion::gravity:
        step_gravity(world);
        break;
      case Motion::slow:
        step_brownian(world, start, kSlowStep, random);
        break;
      case Motion::few:
        step_some(world, start, kFewMove, kStep, seed, random);
        break;
      case Motion::darts:
        step_some(world, start, kDarts, kDartStep, seed, random);
        break;
      case Motion::still:
        break;
    }
    frames.push_back(snapshot(world, start, flags));
  }
  return frames;
}

}  // namespace octocell
