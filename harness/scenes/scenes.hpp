// SPDX-License-Identifier: MIT
// Generators of scenes: "gas:n=1e5,seed=7". For files see harness/files/load.hpp.
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
namespace families {
class GeneratedSpheres;
}

struct SceneInfo {
  std::string_view name;
  std::string_view summary;
  std::span<const ParameterInfo> parameters;
  void (*make)(const Parameters&, families::GeneratedSpheres&);
};

/// Returns the table of all generators.
std::span<const SceneInfo> scenes();

/// Returns the parameters that every generator has in addition: static, groups.
std::span<const ParameterInfo> flag_parameters();

/// Whether Scene::unrounded keeps the float64 numbers that a generator rounds.
enum class Unrounded : bool { forget, keep };

/// Makes a scene. `spec` is `name` or `name:parameter=value,...`. The same spec gives the same bits
/// on every machine, with every compiler and every flag (but -ffast-math is refused). Throws
/// InputError, which lists what is known, and LimitError if there is not enough memory.
Scene generate(std::string_view spec, Unrounded unrounded = Unrounded::forget);

}  // namespace octocell
