// SPDX-License-Identifier: MIT
#pragma once

#include "harness/scenes/scene.hpp"

namespace octocell {

/// Removes the spheres that are not valid, with their flags and unrounded numbers. Adds a note that
/// says how many they were and which was the first.
void leave_out_invalid(Scene& scene);

}  // namespace octocell
