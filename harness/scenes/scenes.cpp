// SPDX-License-Identifier: MIT
#include "harness/scenes/scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/scenes/families.hpp"
#include "harness/scenes/flag_parameters.hpp"
#include "harness/scenes/parameters.hpp"

namespace octocell {
namespace {

constexpr auto kReal = ParameterInfo::Kind::real;
constexpr auto kWhole = ParameterInfo::Kind::whole;
constexpr double kMost = static_cast<double>(kMaxSpheres);

constexpr ParameterInfo count_up_to(double most, double preset = 100000) {
  return {"n", "spheres", preset, 0, most, kWhole};
}
constexpr ParameterInfo filled(double preset) {
  return {"phi", "volume (discs: area) of all spheres / of the box", preset, 1e-6, 100, kReal};
}
constexpr ParameterInfo radii_to(double preset) {
  return {"ratio", "largest radius / smallest radius", preset, 1, 1e6, kReal};
}
constexpr ParameterInfo spaced(double preset) {
  return {"spacing", "distance of neighbours", preset, 1e-6, 1e6, kReal};
}
// Float64 represents all whole numbers up to 2^53.
constexpr ParameterInfo kSeed{"seed", "of the random numbers", 1, 0, 9007199254740991, kWhole};

constexpr ParameterInfo kGas[] = {count_up_to(kMost), kSeed, filled(0.1)};
constexpr ParameterInfo kDense[] = {count_up_to(kMost), kSeed, filled(0.4)};
constexpr ParameterInfo kShifted[] = {
    count_up_to(kMost),
    kSeed,
    filled(0.1),
    {"offset", "centre of the box on all three axes", 1e6, -1e30, 1e30, kReal}};
constexpr ParameterInfo kPoly[] = {count_up_to(kMost), kSeed, filled(0.1), radii_to(10)};
constexpr ParameterInfo kCluster[] = {
    count_up_to(kMost),
    kSeed,
    filled(0.01),
    {"clusters", "number of clouds", 64, 1, 1e6, kWhole},
    {"share", "part of the spheres that are in clouds", 0.9, 0, 1, kReal},
    {"peak", "volume fraction in the middle of a cloud", 0.4, 1e-6, 100, kReal}};
constexpr ParameterInfo kLattice[] = {
    count_up_to(kMost),
    kSeed,
    spaced(1),
    {"shuffle", "1: in random order, 0: row by row", 0, 0, 1, kWhole}};
constexpr ParameterInfo kGiant[] = {
    count_up_to(kMost),
    kSeed,
    filled(0.1),
    {"size", "radius of the giant / side of the box", 0.3, 0, 100, kReal}};
constexpr ParameterInfo kDiscs[] = {count_up_to(kMost), kSeed, filled(0.1), radii_to(100)};
constexpr ParameterInfo kIdentical[] = {count_up_to(65536, 1000)};
constexpr ParameterInfo kFcc[] = {count_up_to(kMost), spaced(1)};
// Whole coordinates up to 2^24 are exact in float32, so all links of the chain are alike.
constexpr ParameterInfo kChain[] = {count_up_to(0x1p24), spaced(1)};

constexpr SceneInfo kScenes[] = {
    {"gas", "equal spheres, uniform in a cube, 10 % filled", kGas, families::gas},
    {"dense", "as gas, 40 % filled", kDense, families::gas},
    {"poly", "radii 10:1, each octave equally often, 10 % filled", kPoly, families::poly},
    {"cluster", "90 % in 64 dense clouds, the rest uniform", kCluster, families::cluster},
    {"lattice", "cubic lattice, neighbours touch exactly", kLattice, families::lattice},
    {"shifted", "a gas far from the origin", kShifted, families::shifted},
    {"giant", "a gas around one huge sphere", kGiant, families::giant},
    {"discs", "flat (z = 0), radii 100:1 with a power law", kDiscs, families::discs},
    {"identical", "the same sphere many times", kIdentical, families::identical},
    {"chain", "a row of spheres, each touches the next", kChain, families::chain},
    {"fcc", "densest packing, neighbours touch up to roundings", kFcc, families::fcc},
};

const SceneInfo& scene_named(std::string_view name) {
  std::string known;
  for (const SceneInfo& scene : kScenes) {
    if (scene.name == name) return scene;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", scene.name);
  }
  throw InputError(fmt::format("no scene and no file {}; scenes: {}", quote(name), known));
}

}  // namespace

std::span<const SceneInfo> scenes() { return kScenes; }

Scene generate(std::string_view spec, Unrounded unrounded) {
  const std::size_t colon = spec.find(':');
  SceneInfo info = scene_named(spec.substr(0, colon));
  std::vector<ParameterInfo> all(info.parameters.begin(), info.parameters.end());
  all.insert(all.end(), flag_parameters().begin(), flag_parameters().end());
  info.parameters = all;
  const Parameters parameters =
      colon == std::string_view::npos ? Parameters(info) : Parameters(info, spec.substr(colon + 1));
  Scene scene;
  scene.name = info.name;
  scene.spec = fmt::format("{}:{}", info.name, parameters.spelt_out());
  const double count = static_cast<double>(parameters.whole("n"));
  const double bytes = sizeof(Sphere) + (unrounded == Unrounded::keep ? sizeof(DoubleSphere) : 0);
  require_memory(count * bytes, scene.spec);
  try {
    const bool keeps = unrounded == Unrounded::keep;
    families::GeneratedSpheres spheres(parameters.whole("n"), keeps);
    info.make(parameters, spheres);
    scene.spheres = spheres.take_rounded();
    if (keeps) scene.unrounded = spheres.take_unrounded();
    scene.flags = make_scene_flags(parameters, scene.spheres.size());
  } catch (const std::bad_alloc&) {
    throw LimitError(fmt::format("scene {}: not enough memory for the spheres", scene.spec));
  }
  return scene;
}

}  // namespace octocell
