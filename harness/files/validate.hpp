// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/sphere.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell {

/// Returns what is wrong with a sphere, such as "r is -0.5 (must be >= 0)"; empty if it is valid.
std::string flaw_of(const Sphere& sphere);

/// Does the same, and refuses numbers that would become infinite in float32.
std::string flaw_of(const DoubleSphere& sphere);

/// Throws InputError, "SOURCE: sphere 17: r is -0.5 (must be >= 0)", for the first sphere that is
/// not valid, or if there are more than kMaxSpheres. Spheres are counted from 0.
void validate(std::span<const Sphere> spheres, std::string_view source);
void validate(std::span<const DoubleSphere> spheres, std::string_view source);

}  // namespace octocell
