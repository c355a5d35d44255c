// SPDX-License-Identifier: MIT
// Options of a command about its scene, and the loading of that scene.
#pragma once

#include <CLI/CLI.hpp>
#include <string_view>

#include "harness/files/load.hpp"

namespace octocell::cli {

inline constexpr const char* kSceneHelp =
    "A file (octocell list: which), - for standard input, or a generator: gas:n=1e5,seed=7";

/// Adds an option for every member of LoadOptions.
void add_scene_options(CLI::App& sub, LoadOptions& options);

/// Calls load_or_generate() and prints the scene's notes on stderr.
Scene load_and_say(std::string_view scene_argument, const LoadOptions& options);

}  // namespace octocell::cli
