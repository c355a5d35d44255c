// SPDX-License-Identifier: MIT
#include "harness/scenes/flag_parameters.hpp"

#include <cstdint>
#include <span>

#include "core/pair.hpp"

namespace octocell {
namespace {

constexpr ParameterInfo kFlagParameters[] = {
    {"static", "part of the spheres that are static", 0, 0, 1, ParameterInfo::Kind::real, false},
    {"groups", "each sphere is in one of so many, and meets all but its own; 0: no groups", 0, 0,
     15, ParameterInfo::Kind::whole, false}};

std::uint64_t mixed(std::uint64_t number) {
  return mix_pair({static_cast<std::uint32_t>(number >> 32), static_cast<std::uint32_t>(number)});
}

/// Returns the k-th random number of a sphere, uniform in [0, 1), independent of other spheres.
double draw(std::uint64_t seed, std::uint64_t sphere, std::uint64_t k) {
  return static_cast<double>(mixed(mixed(seed) + 2 * sphere + k) >> 11) * 0x1p-53;
}

}  // namespace

std::span<const ParameterInfo> flag_parameters() { return kFlagParameters; }

std::vector<Flags> make_scene_flags(const Parameters& parameters, std::size_t sphere_count) {
  const double share = parameters.real("static");
  const std::uint64_t groups = parameters.whole("groups");
  if (share == 0.0 && groups == 0) return {};
  const std::uint64_t seed = parameters.has("seed") ? parameters.whole("seed") : 1;
  std::vector<Flags> flags(sphere_count);
  for (std::size_t i = 0; i < sphere_count; ++i) {
    const bool is_static = draw(seed, i, 0) < share;
    if (groups == 0) {
      flags[i] = make_flags(is_static, 1, kMaxMask);
      continue;
    }
    const auto number = static_cast<std::uint64_t>(draw(seed, i, 1) * static_cast<double>(groups));
    const std::uint32_t group = 1U << number;
    flags[i] = make_flags(is_static, group, kMaxMask & ~group);
  }
  return flags;
}

}  // namespace octocell
