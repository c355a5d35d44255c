// SPDX-License-Identifier: MIT
// Reads scenes from files, or makes them if the argument names a generator.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "harness/files/load_options.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell {

/// Reads a file in the format that the options or the suffix tell. "-" is standard input; its first
/// bytes tell NPY from a table. All spheres are valid. Throws InputError with the path and, if
/// there is one, the line or the sphere.
Scene load_scene(const std::string& path, const LoadOptions& options = {});

/// Returns the path if the argument names a file, or standard input ("-"), and not a generator.
std::optional<std::string> file_of(std::string_view scene_argument);

/// Loads a file or calls a generator. An argument is a file if it contains a '/', has a known
/// suffix or names an existing file. But the name of a generator always means the generator
/// (./gas means the file). Throws what load_scene() and generate() throw.
Scene load_or_generate(std::string_view scene_argument, const LoadOptions& options = {});

}  // namespace octocell
