// SPDX-License-Identifier: MIT
// One reader per file format; load.cpp picks. All spheres returned are valid.
#pragma once

#include <vector>

#include "harness/scenes/input_file.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {

std::vector<Sphere> load_csv(InputFile& file);
std::vector<Sphere> load_pqr(InputFile& file);
void load_npy(InputFile& file, const LoadOptions& options, Scene& scene);

}  // namespace octocell
