// SPDX-License-Identifier: MIT
// Real scenes: molecules, packings, stars, neurons, robots, from packages of PyPI and Debian.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace octocell {

struct RealScene {
  std::string_view name;
  std::string_view path;  // from the folder of the project
  std::size_t spheres;
  std::string_view about;
};

/// Returns the table of all real scenes, present or not. `make setup` downloads those in data/,
/// `make real` those in data/real/ (scripts/fetch_real_scenes.py).
std::span<const RealScene> real_scenes();

/// Returns true if the scene's file is there.
bool is_there(const RealScene& scene);

}  // namespace octocell
