// SPDX-License-Identifier: MIT
// A scene: spheres with a name, wherever they come from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/sphere.hpp"

namespace octocell {

/// A sphere as a float64 file holds it.
struct DoubleSphere {
  double x;
  double y;
  double z;
  double r;
};

/// To nearest, ties to even.
inline Sphere rounded(const DoubleSphere& s) {
  return {static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z),
          static_cast<float>(s.r)};
}

struct Scene {
  // Both are printable: bytes of a path that cannot be shown are escaped.
  std::string name;  // of the generator, or the file's name without folder and extension
  std::string spec;  // gives the same scene again: every parameter spelt out, or the file's path
  std::vector<Sphere> spheres;
  std::vector<Flags> flags;  // one a sphere, or none
  /// What a float64 file held, or a generator had, before it was rounded to float32; only after
  /// LoadOptions::round_input.
  std::optional<std::vector<DoubleSphere>> unrounded;

  [[nodiscard]] SceneView view() const { return {spheres, flags}; }
};

struct LoadOptions {
  std::optional<std::string> flags = {};  // the path of a side file with flags (NPY)
  /// Accept float64 arrays and round them to float32; keep them, and the float64 numbers that a
  /// generator rounds, in Scene::unrounded.
  bool round_input = false;
};

}  // namespace octocell
