// SPDX-License-Identifier: MIT
// Generators of scenes: "gas:n=1e5,seed=7". Files are harness/files/load.hpp's.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/sphere.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell {

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

}  // namespace octocell
