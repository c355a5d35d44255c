// SPDX-License-Identifier: MIT
// One reader per file format; load.cpp chooses. They add to the scene's spheres, flags and notes.
// All spheres that they add are valid; but with LoadOptions::drop_invalid, invalid ones are added,
// too, and the caller removes them.
#pragma once

#include <vector>

#include "harness/files/input_file.hpp"
#include "harness/files/load_options.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell {

void load_npy(InputFile& file, const LoadOptions& options, Scene& scene);
void load_table(InputFile& file, const LoadOptions& options, Scene& scene);
void load_pqr(InputFile& file, const LoadOptions& options, Scene& scene);

/// Reads the flags of that many spheres from a file of their own.
std::vector<Flags> load_flags(InputFile& file, std::size_t sphere_count);

}  // namespace octocell
