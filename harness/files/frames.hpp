// SPDX-License-Identifier: MIT
// Recorded frames: a folder with one file per frame.
#pragma once

#include <string>
#include <vector>

#include "harness/scenes/motion.hpp"

namespace octocell {

/// Returns every *.npy of a folder that is not hidden, in the natural order of names: f2 before
/// f10. Throws InputError if there is none.
std::vector<std::string> frame_files(const std::string& folder);

/// Returns the spheres of all frames. Throws InputError if the frames hold different numbers of
/// spheres.
Frames load_frames(const std::string& folder);

}  // namespace octocell
