// SPDX-License-Identifier: MIT
// Scenes from files (.npy, .csv, .pqr), and from what names a file or a generator.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "harness/scenes/scene.hpp"

namespace octocell {

/// Reads .npy, .csv or .pqr, whichever the path's extension says. All spheres are valid.
/// Throws InputError with the path and, where there is one, the line or the sphere.
Scene load_scene(const std::string& path, const LoadOptions& options = {});

/// The path, if that argument names a file and no generator.
std::optional<std::string> file_of(std::string_view scene_argument);

/// An argument with a '/', or with a known extension, or that names a file, is a file; but the
/// name of a generator always means the generator (./gas means the file). Throws as both above.
Scene load_or_generate(std::string_view scene_argument, const LoadOptions& options = {});

}  // namespace octocell
