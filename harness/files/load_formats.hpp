// SPDX-License-Identifier: MIT
// One reader per file format; load.cpp chooses. All spheres that they return are valid.
#pragma once

#include <vector>

#include "harness/files/input_file.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell {

void load_csv(InputFile& file, Scene& scene);
std::vector<Sphere> load_pqr(InputFile& file);
void load_npy(InputFile& file, const LoadOptions& options, Scene& scene);

/// Reads the flags of that many spheres from a file of their own.
std::vector<Flags> load_flags(InputFile& file, std::size_t sphere_count);

}  // namespace octocell
