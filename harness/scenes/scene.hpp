// SPDX-License-Identifier: MIT
// A scene: spheres with a name, from a generator or a file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/sphere.hpp"

namespace octocell {

/// A sphere as stored in a float64 file.
struct DoubleSphere {
  double x;
  double y;
  double z;
  double r;
};

/// Rounds to nearest, ties to even.
inline Sphere rounded(const DoubleSphere& s) {
  return {static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z),
          static_cast<float>(s.r)};
}

struct Scene {
  // Both are printable: bytes of a path that cannot be shown are escaped.
  std::string name;  // of the generator, or the file's name without folder and extension
  std::string spec;  // makes the same scene again: every parameter with its value, or the file's
                     // path
  std::vector<Sphere> spheres;
  std::vector<Flags> flags;  // one a sphere, or empty
  /// The float64 numbers of the file or the generator before they were rounded to float32; only if
  /// the caller asked for them.
  std::optional<std::vector<DoubleSphere>> unrounded;

  /// What the reader assumed or left out, one line each, for the user to see.
  std::vector<std::string> notes = {};

  [[nodiscard]] SceneView view() const { return {spheres, flags}; }
};

}  // namespace octocell
