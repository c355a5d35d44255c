// SPDX-License-Identifier: MIT
// Flags for generated scenes, the same for all generators: `gas:n=1e5,static=0.9,groups=3`.
#pragma once

#include <vector>

#include "harness/scenes/parameters.hpp"

namespace octocell {

/// Returns one flag word a sphere, or none if neither parameter asks for flags. Which spheres are
/// static, and which group each is in, depends only on the scene's seed (1 if it has none) and the
/// ids.
std::vector<Flags> make_scene_flags(const Parameters& parameters, std::size_t sphere_count);

}  // namespace octocell
