// SPDX-License-Identifier: MIT
// Where spheres come from: a generator ("gas:n=1e5,seed=7") or a file (.npy, .csv, .pqr).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/interface/sphere.hpp"

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

/// A generator's parameter. Values outside [lowest, highest] are refused.
struct ParameterInfo {
  enum class Kind : bool { real, whole };
  std::string_view name;
  std::string_view summary;
  double preset;
  double lowest;
  double highest;
  Kind kind;
  bool spelt_if_preset = true;  // in Scene::spec
};

class Parameters;

struct SceneInfo {
  std::string_view name;
  std::string_view summary;
  std::span<const ParameterInfo> parameters;
  std::vector<Sphere> (*make)(const Parameters&);
  /// The same before each number is rounded to float32, once and at the end.
  std::vector<DoubleSphere> (*make_unrounded)(const Parameters&);
};

/// The one table of generators.
std::span<const SceneInfo> scenes();

/// What each of them takes besides: static, groups.
std::span<const ParameterInfo> flag_parameters();

/// `spec` is `name` or `name:parameter=value,...`. The same spec gives the same bits on every
/// machine, with every compiler and every flag (but not with -ffast-math, which is refused).
/// Throws InputError (says what is known) and LimitError (not enough memory).
Scene generate(std::string_view spec, const LoadOptions& options = {});

/// Reads .npy, .csv or .pqr, whichever the path's extension says. All spheres are valid.
/// Throws InputError with the path and, where there is one, the line or the sphere.
Scene load_scene(const std::string& path, const LoadOptions& options = {});

/// The path, if that argument names a file and no generator.
std::optional<std::string> file_of(std::string_view scene_argument);

/// An argument with a '/', or with a known extension, or that names a file, is a file; but the
/// name of a generator always means the generator (./gas means the file). Throws as both above.
Scene load_or_generate(std::string_view scene_argument, const LoadOptions& options = {});

}  // namespace octocell
