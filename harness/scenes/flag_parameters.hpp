// SPDX-License-Identifier: MIT
// Flags for generated scenes, handled once for all generators: `gas:n=1e5,static=0.9,groups=3`.
#pragma once

#include <vector>

#include "harness/scenes/parameters.hpp"

namespace octocell {

/// One a sphere, or none if neither parameter asks for any. Which spheres are static and which are
/// in which group follows from the scene's seed (1 where it has none) and their ids alone.
std::vector<Flags> make_scene_flags(const Parameters& parameters, std::size_t sphere_count);

}  // namespace octocell
