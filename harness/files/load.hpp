// SPDX-License-Identifier: MIT
// Reads scenes from files (.npy, .csv, .pqr), or makes them if the argument names a generator.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "harness/scenes/scene.hpp"

namespace octocell {

/// Reads .npy, .csv or .pqr, chosen by the path's extension. All spheres are valid. Throws
/// InputError with the path and, if there is one, the line or the sphere.
Scene load_scene(const std::string& path, const LoadOptions& options = {});

/// Returns the path if the argument names a file and not a generator.
std::optional<std::string> file_of(std::string_view scene_argument);

/// Loads a file or calls a generator. An argument is a file if it contains a '/', has a known
/// extension or names an existing file. But the name of a generator always means the generator
/// (./gas means the file). Throws what load_scene() and generate() throw.
Scene load_or_generate(std::string_view scene_argument, const LoadOptions& options = {});

}  // namespace octocell
